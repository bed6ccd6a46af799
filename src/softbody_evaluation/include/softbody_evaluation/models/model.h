#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// The surface of a body with its pictures.
struct Model {
  std::string name;                 ///< of the file
  TriangleMesh mesh;                ///< [m]
  std::vector<float> seen;          ///< empty, or #V: 1 measured, 0 never seen by the camera that scanned it
  Points texture_coordinates;       ///< empty, or 3 #F rows (u, v, 0), in the order of the triangles' corners
  std::vector<int> picture;         ///< empty, or #F: index into `pictures`; -1: none
  std::vector<cv::Mat3b> pictures;  ///< BGR
};

/// Reads a mesh file in metres, an object YAML, or a folder with object.yaml. A scan's PLY says in the vertex
/// property `seen` what was measured; in a folder it is scan.ply.
/// @throw std::invalid_argument with the file and what is wrong with it.
Model readModel(const std::string& path, std::vector<std::string>* warnings);

/// Length of the diagonal of the bounding box of the vertices that triangles use [m].
double diagonalOf(const TriangleMesh& mesh);

/// Colour of a place: BGR, 0..255; NaN without a picture.
/// @param weights of the triangle's corners.
Eigen::Vector3d colorAt(const Model& model, int triangle, const Eigen::Vector3d& weights);

}  // namespace softbody::evaluation
