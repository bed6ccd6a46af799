#include "io/ply_file.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "io/polygon_soup.h"
#include "softbody_common/files/ply_reader.h"

namespace softbody {
namespace {

/// Vertices, faces and pictures of a PLY file.
class PlySurface {
 public:
  explicit PlySurface(const std::string& path) : path_(path), reader_(path) {
    for (const PlyReader::Comment& comment : reader_.comments()) {
      if (comment.keyword == "TextureFile" && !comment.rest.empty())
        pictures_.push_back({path, comment.line, comment.keyword, comment.rest});
    }
  }

  SurfaceFile read(Warnings* warnings) {
    while (reader_.next()) {
      if (reader_.element() == "vertex") addVertex();
      if (reader_.element() == "face") addFace();
      if (reader_.element() == "tristrips")
        reader_.fail("triangle strips are not supported; open the file in MeshLab and save it again");
    }
    SurfaceFile file = triangulated(soup_, path_, ": face ", warnings);
    for (const FileReference& picture : pictures_) file.materials.push_back(picture.name);
    file.references = std::move(pictures_);
    file.seen = std::move(seen_);
    return file;
  }

 private:
  void addVertex() {
    const Eigen::RowVector3d position(reader_.valueOf({"x"}), reader_.valueOf({"y"}), reader_.valueOf({"z"}));
    std::string message;
    if (!position.allFinite())
      message = fmt::format("{}: {}: x, y and z must be finite numbers", path_, reader_.where());
    soup_.addVertex(position, message);
    const std::vector<double>&u = reader_.valuesOf({"s", "u", "texture_u"}),
          &v = reader_.valuesOf({"t", "v", "texture_v"});
    has_vertex_texture_ = !u.empty() && !v.empty();
    if (has_vertex_texture_) soup_.texture.emplace_back(u.front(), v.front(), 0.0);
    const std::vector<double>& seen = reader_.valuesOf({"seen"});
    if (!seen.empty()) seen_.push_back(static_cast<float>(seen.front()));
  }

  /// Texture coordinates of the face's corners come before those of its vertices.
  void addFace() {
    const std::vector<double>&vertices = reader_.valuesOf({"vertex_indices", "vertex_index"}),
          &texture = reader_.valuesOf({"texcoord"});
    const bool has_texture = !texture.empty() && texture.size() == 2 * vertices.size();
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const int vertex = indexOf(vertices[k]);
      const int of_vertex = has_vertex_texture_ ? vertex : -1;
      corners.push_back({vertex, has_texture ? static_cast<int>(soup_.texture.size()) : of_vertex});
      if (has_texture) soup_.texture.emplace_back(texture[2 * k], texture[2 * k + 1], 0.0);
    }
    const double picture = reader_.valueOf({"texnumber"});
    const bool is_known = picture >= 0.0 && picture < static_cast<double>(pictures_.size());
    const int only = pictures_.size() == 1 ? 0 : -1;
    soup_.addFace(corners, is_known ? static_cast<int>(picture) : only, static_cast<int>(reader_.item()));
  }

  int indexOf(double value) const {
    if (!(value >= 0.0 && value < std::numeric_limits<int>::max() && value == std::floor(value)))
      reader_.fail(fmt::format("'{}' is not a vertex index", value));
    return static_cast<int>(value);
  }

  std::string path_;
  PlyReader reader_;
  std::vector<FileReference> pictures_;
  PolygonSoup soup_;
  bool has_vertex_texture_ = false;
  std::vector<float> seen_;
};

}  // namespace

SurfaceFile readPly(const std::string& path, Warnings* warnings) { return PlySurface(path).read(warnings); }

}  // namespace softbody
