#include "tool/expected_markers.h"

#include <Eigen/Geometry>

#include "tool/tool_pose.h"

namespace softbody {
namespace {

constexpr double kSigmas = 3.5;       // of the prediction: 99.95 % along each axis of the image
constexpr double kMinDepth_m = 0.01;  // [m] a marker nearer to the camera plane has no usable projection

/// Corners of a marker with a margin of one cell, in the tool's frame [m].
Eigen::Matrix<double, 3, 4> withMargin(ToolMarker marker, int cells) {
  marker.size_m *= (cells + 2.0) / cells;
  return markerCorners(marker);
}

}  // namespace

std::optional<ExpectedMarkers> expectedMarkers(const ToolDescription& tool, int cells, const Pinhole& camera,
                                               const PoseMotion::Prediction& predicted) {
  const Eigen::Isometry3d& T = predicted.pose;
  Eigen::AlignedBox2d box;
  double perimeters_px = 0.0;
  for (const ToolMarker& marker : tool.markers) {
    const Eigen::Matrix<double, 3, 4> corners = withMargin(marker, cells);
    Eigen::Matrix<double, 2, 4> pixels;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d turned = T.linear() * corners.col(k), p = turned + T.translation();
      if (!(p.z() > kMinDepth_m)) return std::nullopt;
      const Eigen::Matrix<double, 2, 6> J = pixelByPose(camera, turned, p);
      const Eigen::Vector2d reach =
          kSigmas * (J * predicted.covariance * J.transpose()).diagonal().cwiseSqrt();
      pixels.col(k) = camera.project(p);
      box.extend(pixels.col(k) - reach).extend(pixels.col(k) + reach);
    }
    for (int k = 0; k < 4; ++k) perimeters_px += (pixels.col(k) - pixels.col((k + 1) % 4)).norm();
  }
  const Eigen::Array2d image(camera.width, camera.height);
  const Eigen::Array2d low = box.min().array().max(0.0).min(image),
                       high = box.max().array().max(0.0).min(image);
  const double cells_around = 4.0 * (cells + 2.0) * static_cast<double>(tool.markers.size());
  return ExpectedMarkers{{cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
                          cv::Point(static_cast<int>(high.x()), static_cast<int>(high.y()))},
                         perimeters_px / cells_around};
}

}  // namespace softbody
