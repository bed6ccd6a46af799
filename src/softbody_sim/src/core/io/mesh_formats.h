#pragma once

#include <string>

#include "softbody_sim/io/mesh_files.h"

// One reader per format, for readSurfaceFile and readTetFile. Indices come back checked, tets in whatever
// order.

namespace softbody {

SurfaceFile readObj(const std::string& path, Warnings* warnings);
SurfaceFile readOff(const std::string& path);
SurfaceFile readPly(const std::string& path);
SurfaceFile readStl(const std::string& path);

TetMesh readVtu(const std::string& path, Warnings* warnings);
TetMesh readMsh(const std::string& path, Warnings* warnings);
TetMesh readVeg(const std::string& path, Warnings* warnings);
/// @param path of the .node or of the .ele file.
TetMesh readTetGen(const std::string& path, Warnings* warnings);

/// Rows of a list as a matrix.
template <typename Matrix, typename Row>
Matrix stackRows(const std::vector<Row>& rows) {
  Matrix matrix(static_cast<Eigen::Index>(rows.size()), Matrix::ColsAtCompileTime);
  for (std::size_t r = 0; r < rows.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = rows[r];
  return matrix;
}

/// Lower-case extension without its dot.
std::string extensionOf(const std::string& path);

}  // namespace softbody
