#include "softbody_common/cutting/blade.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <stdexcept>

namespace softbody {
namespace {

constexpr double kFlatness =
    0.02;  // of the blade's length: how far its corners may lie apart across its plane
constexpr double kMinWidth = 1e-3;  // of the blade's length; a narrower blade is a line

}  // namespace

void requireBladeCorners(std::size_t count) {
  if (count >= 3 && count <= kMostBladeCorners) return;
  throw std::invalid_argument(
      fmt::format("the blade has {} corners; allowed: 3 to {}", count, kMostBladeCorners));
}

std::string bladeFault(const Points& corners) {
  const double span = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).norm();
  if (span > kLargestTool_m)
    return fmt::format("spans {:.4g} m; allowed: up to {} m; lengths are in metres", span, kLargestTool_m);
  const Points centred = corners.rowwise() - corners.colwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinV);
  const Eigen::MatrixXd along = centred * svd.matrixV();
  const Eigen::RowVector3d extent = along.colwise().maxCoeff() - along.colwise().minCoeff();
  if (extent(1) <= kMinWidth * extent(0) || extent(0) <= 0.0)
    return "has no area: its corners lie on one line";
  if (extent(2) <= kFlatness * extent(0)) return "";
  return fmt::format("is not planar: its corners lie up to {:.1f} mm apart across their common plane",
                     1e3 * extent(2));
}

}  // namespace softbody
