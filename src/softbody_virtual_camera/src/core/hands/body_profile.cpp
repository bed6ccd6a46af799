#include "hands/body_profile.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody::virtual_camera {
namespace {

constexpr double kProfileStep = 2e-3, kProfileLength = 0.1;  // [m]
constexpr double kMissed = -std::numeric_limits<double>::infinity();

}  // namespace

double BodyProfile::at(double place) const {
  const double last = static_cast<double>(heights.size() - 1);
  const double steps = std::clamp(place / kProfileStep, 0.0, last);
  const auto below = static_cast<std::size_t>(std::min(steps, last - 1.0));
  const double share = steps - static_cast<double>(below);
  return (1.0 - share) * heights[below] + share * heights[below + 1];
}

BodyProfile profileOf(const TriangleMesh& body, const Eigen::Vector3d& start, const Eigen::Vector3d& along,
                      const Eigen::Vector3d& side) {
  const int count = static_cast<int>(kProfileLength / kProfileStep) + 1;
  Eigen::Matrix3d axes;
  axes << along, side.cross(along), side;
  const Points places = (body.vertices.rowwise() - start.transpose()) * axes;
  BodyProfile profile{std::vector<double>(static_cast<std::size_t>(count), kMissed)};
  for (Eigen::Index f = 0; f < body.triangles.rows(); ++f) {
    const Eigen::Matrix3d corners = places(body.triangles.row(f).transpose(), Eigen::all);
    if (corners.col(1).minCoeff() > 0.0 || corners.col(1).maxCoeff() < 0.0) continue;
    const int first = std::max(0, static_cast<int>(std::ceil(corners.col(0).minCoeff() / kProfileStep)));
    const int last = std::min(count - 1, static_cast<int>(corners.col(0).maxCoeff() / kProfileStep));
    Eigen::Matrix3d flat = corners.transpose();
    flat.row(2).setOnes();
    if (std::abs(flat.determinant()) < 1e-15) continue;
    for (int i = first; i <= last; ++i) {
      const Eigen::Vector3d weights = flat.inverse() * Eigen::Vector3d(i * kProfileStep, 0.0, 1.0);
      if (weights.minCoeff() < -1e-9) continue;
      double& height = profile.heights[static_cast<std::size_t>(i)];
      height = std::max(height, corners.col(2).dot(weights));
    }
  }
  double next = 0.0;
  for (auto height = profile.heights.rbegin(); height != profile.heights.rend(); ++height) {
    if (*height == kMissed) *height = next;
    next = *height;
  }
  return profile;
}

}  // namespace softbody::virtual_camera
