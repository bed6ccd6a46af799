#include "cutting/blade/tear_reach.h"

#include <cmath>
#include <optional>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr std::size_t kFewest = 6;  // marks of a side, which make a rigid motion sure

/// The rigid motion of the marks on one side.
struct RigidSide {
  Eigen::Isometry3d motion;
  double height_m = 0.0;        ///< mean, over the plane
  double mean_square_m2 = 0.0;  ///< misfit
};

std::optional<RigidSide> rigidSide(const std::vector<TearMark>& marks, double side, const RestPlane& plane) {
  std::vector<const TearMark*> on_side;
  for (const TearMark& mark : marks)
    if (mark.side == side) on_side.push_back(&mark);
  if (on_side.size() < kFewest) return std::nullopt;
  Points rest(static_cast<Eigen::Index>(on_side.size()), 3), measured(rest.rows(), 3);
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    rest.row(i) = on_side[static_cast<std::size_t>(i)]->rest;
    measured.row(i) = on_side[static_cast<std::size_t>(i)]->measured;
  }
  const Eigen::Isometry3d motion = fitRigid(rest, measured);
  return RigidSide{motion, plane.normal.dot(rest.colwise().mean().transpose() - plane.point),
                   (transformed(rest, motion) - measured).rowwise().squaredNorm().mean()};
}

}  // namespace

std::vector<double> stretchAcross(const TetTopology& volume, const std::vector<TetStretch>& stretches,
                                  const RestPlane& plane, const std::vector<TearMark>& marks) {
  std::vector<double> across;
  across.reserve(stretches.size());
  for (const TetStretch& own : stretches) across.push_back(own.stretch);
  const auto above = rigidSide(marks, 1.0, plane), below = rigidSide(marks, -1.0, plane);
  if (!above || !below || above->height_m <= below->height_m) return across;
  const double length = above->height_m - below->height_m;
  const double variance = (above->mean_square_m2 + below->mean_square_m2) / (length * length);
  for (std::size_t t = 0; t < stretches.size(); ++t) {
    const MaterialPoint center{static_cast<int>(t), Eigen::Vector4d::Constant(0.25)};
    Eigen::Vector3d foot = positionOf(center, volume.rest_vertices, volume.tets);
    foot -= plane.normal.dot(foot - plane.point) * plane.normal;
    const Eigen::Vector3d high = above->motion * (foot + above->height_m * plane.normal),
                          low = below->motion * (foot + below->height_m * plane.normal);
    const double own_variance = stretches[t].deviation * stretches[t].deviation;
    across[t] = (variance * stretches[t].stretch + own_variance * (high - low).norm() / length) /
                (variance + own_variance);
  }
  return across;
}

}  // namespace softbody
