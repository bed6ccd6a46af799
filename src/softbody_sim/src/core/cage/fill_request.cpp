#include "cage/fill_request.h"

#include <cstring>
#include <stdexcept>

namespace softbody {
namespace {

template <typename T>
void append(const T* values, Eigen::Index count, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(values), sizeof(T) * static_cast<std::size_t>(count));
}

/// The number of rows, then the rows.
template <typename Matrix>
void append(const Matrix& matrix, std::string* bytes) {
  const Eigen::Index rows = matrix.rows();
  append(&rows, 1, bytes);
  append(matrix.data(), matrix.size(), bytes);
}

template <typename T>
void take(Eigen::Index count, T* values, std::string_view* bytes) {
  const std::size_t size = sizeof(T) * static_cast<std::size_t>(count);
  if (bytes->size() < size) throw std::invalid_argument("the mesh between two processes is not complete");
  if (size > 0) std::memcpy(values, bytes->data(), size);
  bytes->remove_prefix(size);
}

template <typename Matrix>
Matrix take(std::string_view* bytes) {
  Eigen::Index rows = 0;
  take(1, &rows, bytes);
  if (rows < 0 || static_cast<std::size_t>(rows) > bytes->size())
    throw std::invalid_argument("the mesh between two processes is not complete");
  Matrix matrix(rows, Matrix::ColsAtCompileTime);
  take(matrix.size(), matrix.data(), bytes);
  return matrix;
}

}  // namespace

std::string toBytes(const FillRequest& request) {
  std::string bytes;
  append(&request.largest_volume, 1, &bytes);
  append(&request.keep_surface, 1, &bytes);
  append(request.surface.vertices, &bytes);
  append(request.surface.triangles, &bytes);
  return bytes;
}

FillRequest fillRequest(std::string_view bytes) {
  FillRequest request;
  take(1, &request.largest_volume, &bytes);
  take(1, &request.keep_surface, &bytes);
  request.surface.vertices = take<Points>(&bytes);
  request.surface.triangles = take<Triangles>(&bytes);
  return request;
}

std::string toBytes(const TetMesh& mesh) {
  std::string bytes;
  append(mesh.vertices, &bytes);
  append(mesh.tets, &bytes);
  return bytes;
}

TetMesh tetMesh(std::string_view bytes) {
  TetMesh mesh;
  mesh.vertices = take<Points>(&bytes);
  mesh.tets = take<Tets>(&bytes);
  return mesh;
}

}  // namespace softbody
