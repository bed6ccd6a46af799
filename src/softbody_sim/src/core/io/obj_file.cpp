#include "io/obj_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>

#include "io/stack_rows.h"
#include "io/text_reader.h"

namespace softbody {
namespace {

struct Corner {
  int vertex = 0;
  int texture = -1;  ///< -1: none
};

struct Face {
  std::array<Corner, 3> corners;
  int line = 0;
};

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : reader_(path) {}

  SurfaceFile read(Warnings* warnings) {
    while (reader_.next()) readLine();
    for (const Face& face : faces_) checkVertices(face);
    SurfaceFile file;
    file.mesh.vertices = stackRows<Points>(vertices_);
    file.mesh.triangles.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (int k = 0; k < 3; ++k)
        file.mesh.triangles(static_cast<Eigen::Index>(f), k) = faces_[f].corners[k].vertex;
    }
    file.texture_coordinates = textureCoordinates(warnings);
    for (const std::string& keyword : ignored_) {
      warnings->push_back(fmt::format("{}: '{}' lines were ignored", reader_.path(), keyword));
    }
    return file;
  }

 private:
  void readLine() {
    static const std::set<std::string_view> kDecoration{"vn", "vp", "o", "g", "s", "usemtl", "mtllib"};
    const std::string_view keyword = reader_.keyword();
    if (keyword == "v") {
      vertices_.push_back(reader_.point(1));
    } else if (keyword == "vt") {
      const double v = reader_.fields().size() > 2 ? reader_.number(2) : 0.0;
      texture_.emplace_back(reader_.number(1), v, 0.0);
    } else if (keyword == "f") {
      readFace();
    } else if (kDecoration.count(keyword) == 0) {
      ignored_.emplace(keyword);
    }
  }

  void readFace() {
    std::vector<Corner> corners;
    for (std::size_t k = 1; k < reader_.fields().size(); ++k)
      corners.push_back(readCorner(reader_.fields()[k]));
    if (corners.size() < 3) reader_.fail(fmt::format("a face of {} corners", corners.size()));
    for (std::size_t k = 2; k < corners.size(); ++k) {
      faces_.push_back({{corners[0], corners[k - 1], corners[k]}, reader_.line()});
    }
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  Corner readCorner(std::string_view text) const {
    const std::size_t slash = text.find('/');
    Corner corner;
    corner.vertex = index(text.substr(0, slash), vertices_.size(), text);
    if (slash == std::string_view::npos) return corner;
    const std::string_view rest = text.substr(slash + 1);
    const std::string_view texture = rest.substr(0, rest.find('/'));
    if (!texture.empty()) corner.texture = index(texture, texture_.size(), text);
    return corner;
  }

  /// 1 is the first entry; -1 is the last entry read so far.
  int index(std::string_view digits, std::size_t so_far, std::string_view corner) const {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      reader_.fail(fmt::format("'{}' is not a face corner", corner));
    }
    const long long zero_based = value > 0 ? value - 1LL : static_cast<long long>(so_far) + value;
    if (value == 0 || zero_based < 0) reader_.fail(fmt::format("face corner '{}' is out of range", corner));
    return static_cast<int>(zero_based);
  }

  void checkVertices(const Face& face) const {
    for (const Corner& corner : face.corners) {
      if (static_cast<std::size_t>(corner.vertex) >= vertices_.size()) {
        reader_.failAt(face.line, fmt::format("a face refers to vertex {}; the file has {} vertices",
                                              corner.vertex + 1, vertices_.size()));
      }
    }
  }

  /// Empty, with a warning, if a corner has no texture coordinate.
  Points textureCoordinates(Warnings* warnings) const {
    if (texture_.empty()) return {};
    Points coordinates(static_cast<Eigen::Index>(3 * faces_.size()), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int texture = faces_[f].corners[k].texture;
        if (texture < 0 || static_cast<std::size_t>(texture) >= texture_.size()) {
          warnings->push_back(
              fmt::format("{}:{}: a face corner without a valid texture coordinate; the texture "
                          "coordinates of this file are ignored",
                          reader_.path(), faces_[f].line));
          return {};
        }
        coordinates.row(static_cast<Eigen::Index>(3 * f + k)) = texture_[static_cast<std::size_t>(texture)];
      }
    }
    return coordinates;
  }

  TextReader reader_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<Eigen::RowVector3d> texture_;
  std::vector<Face> faces_;
  std::set<std::string> ignored_;
};

}  // namespace

SurfaceFile readObj(const std::string& path, Warnings* warnings) { return ObjReader(path).read(warnings); }

}  // namespace softbody
