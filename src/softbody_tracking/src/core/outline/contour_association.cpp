#include "outline/contour_association.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

constexpr int kWantedSamples = 240;  // wanted number of samples around the body
constexpr int kBorder = 8;           // [px] at the image border an outline may be the image's own

}  // namespace

ContourGrid contourGrid(const RasterImage& image) {
  const cv::Rect region = image.region & cv::Rect(kBorder, kBorder, image.depth.cols - 2 * kBorder,
                                                  image.depth.rows - 2 * kBorder);
  return {region, std::max(1, 2 * (region.width + region.height) / kWantedSamples)};
}

Association contourAssociation(const Pinhole& camera, const ContourSample& sample,
                               const Eigen::Vector3d& predicted, const ContourEnd& end,
                               const ContourWeight& weight, int spacing_px) {
  Association association;
  association.place = sample.place;
  association.piece = sample.piece;
  association.predicted = predicted;
  const Eigen::Vector2d pixel = camera.project(predicted) + end.mean * sample.outward;
  association.measured = camera.unproject(pixel.x(), pixel.y(), predicted.z());
  // Normal to the plane through the camera and the contour.
  const Eigen::Vector3d along(-sample.outward.y() / camera.fx, sample.outward.x() / camera.fy, 0.0);
  association.normal = association.measured.cross(along).normalized();
  const double pixel_m = predicted.z() / camera.fx;
  const double precision = kUnitDeviation * kUnitDeviation / (end.variance * pixel_m * pixel_m);
  association.weight =
      std::min(weight.per_edge * precision * spacing_px * pixel_m / weight.edge_m, kLargestTargetWeight);
  return association;
}

}  // namespace softbody
