#include "softbody_bringup/virtual_camera/obj_file.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace softbody::virtual_camera {
namespace {

/// The vertex index of "7", "7/1", "7//2" or "-1".
int vertexIndex(const std::string& corner, int vertex_count) {
  const int number = std::stoi(corner.substr(0, corner.find('/')));
  return number < 0 ? vertex_count + number : number - 1;
}

std::vector<int> readFace(std::istringstream* line, int vertex_count) {
  std::vector<int> face;
  for (std::string corner; *line >> corner;) {
    face.push_back(vertexIndex(corner, vertex_count));
    if (face.back() < 0 || face.back() >= vertex_count) throw std::out_of_range(corner);
  }
  if (face.size() < 3) throw std::out_of_range("face");
  return face;
}

template <typename Matrix>
Matrix stack(const std::vector<Eigen::Matrix<typename Matrix::Scalar, 1, 3>>& rows) {
  Matrix matrix(static_cast<Eigen::Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) matrix.row(static_cast<Eigen::Index>(i)) = rows[i];
  return matrix;
}

}  // namespace

TriangleMesh readObj(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(fmt::format("{}: cannot be opened", path));
  std::vector<Eigen::RowVector3d> vertices;
  std::vector<Eigen::RowVector3i> triangles;
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    ++number;
    std::istringstream line(text);
    std::string keyword;
    line >> keyword;
    try {
      if (keyword == "v") {
        Eigen::RowVector3d p;
        if (!(line >> p.x() >> p.y() >> p.z())) throw std::out_of_range("vertex");
        vertices.push_back(p);
      } else if (keyword == "f") {
        const std::vector<int> face = readFace(&line, static_cast<int>(vertices.size()));
        for (std::size_t k = 2; k < face.size(); ++k) triangles.emplace_back(face[0], face[k - 1], face[k]);
      }
    } catch (const std::logic_error&) {
      throw std::invalid_argument(
          fmt::format("{}, line {}: '{}' is not a valid vertex or face", path, number, text));
    }
  }
  if (triangles.empty()) throw std::invalid_argument(fmt::format("{}: holds no faces", path));
  return {stack<Points>(vertices), stack<Triangles>(triangles)};
}

}  // namespace softbody::virtual_camera
