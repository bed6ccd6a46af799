#include "softbody_evaluation/measures/surface_samples.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "softbody_common/statistics/random.h"

namespace softbody::evaluation {
namespace {

/// Areas of the triangles up to each one, summed.
std::vector<double> summedAreas(const TriangleMesh& mesh) {
  std::vector<double> sums;
  double sum = 0.0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::RowVector3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
                             c = mesh.vertices.row(t[2]);
    sum += 0.5 * (b - a).cross(c - a).norm();
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

std::vector<SurfaceSample> sampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  const std::vector<double> areas = summedAreas(mesh);
  if (areas.empty() || !(areas.back() > 0.0)) throw std::invalid_argument("the surface has no area");
  std::vector<SurfaceSample> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t h = hash(seed, i);
    const double place = (static_cast<double>(i) + unit(h)) / static_cast<double>(count) * areas.back();
    const auto found = std::upper_bound(areas.begin(), areas.end() - 1, place);
    SurfaceSample& sample = samples[i];
    sample.triangle = static_cast<int>(found - areas.begin());
    const double root = std::sqrt(unit(hash(h))), share = unit(hash(h, 1));
    sample.weights = {1.0 - root, root * (1.0 - share), root * share};
    for (int k = 0; k < 3; ++k)
      sample.position +=
          sample.weights[k] * mesh.vertices.row(mesh.triangles(sample.triangle, k)).transpose();
  }
  return samples;
}

double interpolated(const std::vector<float>& values, const Triangles& triangles, int triangle,
                    const Eigen::Vector3d& weights) {
  double value = 0.0;
  for (int k = 0; k < 3; ++k) value += weights[k] * values[static_cast<std::size_t>(triangles(triangle, k))];
  return value;
}

}  // namespace softbody::evaluation
