#pragma once

#include <cstdint>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// A point of a surface.
struct SurfaceSample {
  int triangle = -1;
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();   ///< of the triangle's corners, sum 1
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
};

/// Points that cover the surface evenly: each has an equal share of the area. The seed selects them.
/// @throw std::invalid_argument if the surface has no area.
std::vector<SurfaceSample> sampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

/// Value of a place from values of the vertices.
double interpolated(const std::vector<float>& values, const Triangles& triangles, int triangle,
                    const Eigen::Vector3d& weights);

}  // namespace softbody::evaluation
