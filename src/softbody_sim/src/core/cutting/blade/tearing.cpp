#include "cutting/blade/tearing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "cutting/patch/plane_section.h"
#include "softbody_common/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

/// Consecutive states beyond the limit: one wrong measurement or the vibration after a cut does not tear.
constexpr int kStates = 5;
// A tear that has begun runs on where the strain is above this share of the limit: at its tip the stress is
// larger.
constexpr double kRuns = 0.5;
constexpr double kFurther = 1.1;   // factor over the stretch of a patch that was not cut
constexpr double kOverhang = 0.1;  // over the mean edge length

/// Of F^T F = V diag(stretch^2) V^T, F the deformation gradient.
Eigen::Matrix3d rightCauchyGreen(const TetTopology& volume, const Points& vertices, int tet) {
  const Eigen::RowVector4i corners = volume.tets.row(tet);
  const Eigen::Matrix3d F = edgesOf(vertices, corners) * edgesOf(volume.rest_vertices, corners).inverse();
  return F.transpose() * F;
}

}  // namespace

PrincipalStretch principalStretch(const TetTopology& volume, const Points& vertices, int tet) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(rightCauchyGreen(volume, vertices, tet));
  return {std::sqrt(std::max(0.0, solver.eigenvalues()[2])), solver.eigenvectors().col(2)};
}

std::optional<CutPatch> TearWatch::follow(const TetTopology& volume, const Points& vertices) {
  if (strain_ <= 0.0) return std::nullopt;
  const auto count = static_cast<std::size_t>(volume.tets.rows());
  if (revision_ != volume.revision || states_beyond_.size() != count) {
    states_beyond_.assign(count, 0);
    asked_at_.assign(count, 0.0);
  }
  revision_ = volume.revision;
  int first = -1;
  PrincipalStretch most;
  std::vector<bool> torn(count, false);
  for (std::size_t t = 0; t < count; ++t) {
    const PrincipalStretch now = principalStretch(volume, vertices, static_cast<int>(t));
    const bool beyond = now.stretch > 1.0 + strain_;
    torn[t] = now.stretch > 1.0 + kRuns * strain_;
    states_beyond_[t] = beyond ? states_beyond_[t] + 1 : 0;
    if (!beyond) asked_at_[t] = 0.0;
    const bool asks = states_beyond_[t] >= kStates && now.stretch > kFurther * asked_at_[t];
    if (!asks || (first >= 0 && now.stretch <= most.stretch)) continue;
    first = static_cast<int>(t);
    most = now;
  }
  if (first < 0) return std::nullopt;
  states_beyond_.assign(count, 0);
  asked_at_[static_cast<std::size_t>(first)] = most.stretch;
  const MaterialPoint middle{first, Eigen::Vector4d::Constant(0.25)};
  return planeSection(volume, positionOf(middle, volume.rest_vertices, volume.tets), most.direction, first,
                      torn, kOverhang * meanEdgeLength(volume.rest_vertices, volume.tets));
}

}  // namespace softbody
