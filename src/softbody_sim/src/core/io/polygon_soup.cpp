#include "io/polygon_soup.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "plane/polygon_triangles.h"
#include "softbody_common/files/stack_rows.h"

namespace softbody {
namespace {

class Triangulation {
 public:
  Triangulation(const PolygonSoup& soup, const std::string& path, const std::string& place)
      : soup_(soup), path_(path), place_(place) {}

  SurfaceFile result(Warnings* warnings) {
    std::vector<Corner> face;
    std::size_t begin = 0;
    for (const PolygonSoup::Face& f : soup_.faces) {
      face.assign(soup_.corners.begin() + begin, soup_.corners.begin() + f.end_corner);
      begin = f.end_corner;
      addFace(face, f);
    }
    SurfaceFile file;
    file.mesh.vertices = stackRows<Points>(soup_.vertices);
    file.mesh.triangles.resize(static_cast<Eigen::Index>(materials_.size()), 3);
    for (Eigen::Index k = 0; k < file.mesh.triangles.size(); ++k)
      file.mesh.triangles(k / 3, k % 3) = corners_[static_cast<std::size_t>(k)].vertex;
    // Vertices stay in file order. A place that the surface already has disturbs nobody.
    for (const auto& [vertex, complaint] : soup_.bad_vertices)
      file.mesh.vertices.row(vertex) = file.mesh.vertices.row(corners_.empty() ? 0 : corners_.front().vertex);
    file.texture_coordinates = textureCoordinates();
    file.material = std::move(materials_);
    warn(warnings);
    return file;
  }

 private:
  void addFace(const std::vector<Corner>& corners, const PolygonSoup::Face& face) {
    std::set<int> vertices;
    for (const Corner& corner : corners) vertices.insert(corner.vertex);
    for (const int vertex : vertices) checkVertex(vertex, face.place);
    if (vertices.size() < 3) {
      if (small_++ == 0) first_small_ = face.place;
      return;
    }
    Points positions(static_cast<Eigen::Index>(corners.size()), 3);
    for (std::size_t k = 0; k < corners.size(); ++k)
      positions.row(static_cast<Eigen::Index>(k)) =
          soup_.vertices[static_cast<std::size_t>(corners[k].vertex)];
    const PolygonTriangles split = polygonTriangles(positions);
    if (!split.is_exact && crossed_++ == 0) first_crossed_ = face.place;
    for (const auto& triangle : split.triangles) {
      for (const int k : triangle) corners_.push_back(corners[static_cast<std::size_t>(k)]);
      materials_.push_back(face.material);
    }
  }

  void checkVertex(int vertex, int place) const {
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= soup_.vertices.size()) {
      throw std::invalid_argument(
          fmt::format("{}{}{}: a face refers to vertex {}, counted from 0; the file has {} vertices", path_,
                      place_, place, vertex, soup_.vertices.size()));
    }
    const auto bad = soup_.bad_vertices.find(vertex);
    if (bad != soup_.bad_vertices.end()) throw std::invalid_argument(bad->second);
  }

  Points textureCoordinates() {
    Points coordinates = Points::Zero(static_cast<Eigen::Index>(corners_.size()), 3);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const auto texture = static_cast<std::size_t>(corners_[k].texture);  // -1 becomes large
      if (texture < soup_.texture.size() && soup_.texture[texture].allFinite())
        coordinates.row(static_cast<Eigen::Index>(k)) = soup_.texture[texture];
      else
        ++untextured_;
    }
    return untextured_ < corners_.size() ? coordinates : Points();
  }

  void warn(Warnings* warnings) const {
    if (!soup_.bad_vertices.empty())
      warnings->push_back(fmt::format("{}: {} vertices that no face uses are not finite; they do not matter",
                                      path_, soup_.bad_vertices.size()));
    if (small_ > 0)
      warnings->push_back(
          fmt::format("{}{}{}: a face without three different corners; {} of them were dropped", path_,
                      place_, first_small_, small_));
    if (crossed_ > 0)
      warnings->push_back(fmt::format("{}{}{}: a polygon crosses itself; {} of them were split into fans",
                                      path_, place_, first_crossed_, crossed_));
    if (untextured_ > 0 && !soup_.texture.empty())
      warnings->push_back(fmt::format(
          "{}: {} of {} triangle corners have no finite texture coordinate; {}", path_, untextured_,
          corners_.size(), untextured_ < corners_.size() ? "they got (0, 0)" : "there is no texture"));
  }

  const PolygonSoup& soup_;
  const std::string &path_, &place_;
  std::vector<Corner> corners_;  ///< of the triangles
  std::vector<int> materials_;
  std::size_t small_ = 0, crossed_ = 0, untextured_ = 0;
  int first_small_ = 0, first_crossed_ = 0;
};

}  // namespace

void PolygonSoup::addVertex(const Eigen::RowVector3d& position, const std::string& complaint) {
  if (!position.allFinite()) bad_vertices.emplace(static_cast<int>(vertices.size()), complaint);
  vertices.push_back(position);
}

void PolygonSoup::addVertex(const TextReader& reader, std::size_t first_field) {
  Eigen::RowVector3d position;
  std::string message;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view field = reader.field(first_field + k);
    position[static_cast<int>(k)] = parseNumber(field);
    if (!position.head(static_cast<int>(k) + 1).allFinite() && message.empty())
      message = fmt::format("{}:{}: '{}' is not a finite number", reader.path(), reader.line(), field);
  }
  addVertex(position, message);
}

void PolygonSoup::addFace(const std::vector<Corner>& face, int material, int place) {
  corners.insert(corners.end(), face.begin(), face.end());
  faces.push_back({corners.size(), material, place});
}

SurfaceFile triangulated(const PolygonSoup& soup, const std::string& path, const std::string& place,
                         Warnings* warnings) {
  return Triangulation(soup, path, place).result(warnings);
}

}  // namespace softbody
