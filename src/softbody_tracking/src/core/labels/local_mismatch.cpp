#include "labels/local_mismatch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

// Standard deviations from which a patch contradicts the prediction. Where meshes and poses are right, hardly
// any patch of the recorded toy and of the virtual camera's scenes reaches that.
constexpr double kSignificant = 5.0;

/// For each pixel of the labels where the body is rendered and the background is seen: its distance from the
/// nearest other pixel [px]; 0 elsewhere.
cv::Mat1f depthOfEmpty(const Labels& labels, const cv::Mat1f& rendered) {
  cv::Mat1b empty;
  cv::bitwise_and(labels.label == labels::kBackground, rendered(labels.region) > 0.0f, empty);
  cv::copyMakeBorder(empty, empty, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1f distance;
  cv::distanceTransform(empty, distance, cv::DIST_L2, 5);
  return distance(cv::Rect({1, 1}, labels.region.size()));
}

/// Largest deviation of the vertices around the surface at a pixel [m].
double deviationAt(const PredictedSurface& surface, const cv::Point& pixel,
                   const std::vector<float>& deviations) {
  const TetTopology& volume = surface.volume();
  if (deviations.size() != static_cast<std::size_t>(volume.rest_vertices.rows())) return 0.0;
  const int tet = surface.materialPoint(surface.image().triangle(pixel), pixel).tet;
  if (tet < 0) return 0.0;
  float largest = 0.0f;
  for (int corner = 0; corner < 4; ++corner)
    largest = std::max(largest, deviations[static_cast<std::size_t>(volume.tets(tet, corner))]);
  return largest;
}

/// @param pixel in the image.
std::string sideOf(const cv::Point& pixel, const cv::Rect& body) {
  const double right = (pixel.x - body.x) / static_cast<double>(body.width) - 0.5;
  const double down = (pixel.y - body.y) / static_cast<double>(body.height) - 0.5;
  if (std::abs(right) >= std::abs(down)) return right < 0.0 ? "left" : "right";
  return down < 0.0 ? "upper" : "lower";
}

}  // namespace

std::optional<LocalMismatch> localMismatch(const Labels& labels, const PredictedSurface& surface,
                                           double usual_error_m, double outline_px,
                                           const std::vector<float>& deviations) {
  if (labels.region.empty() || outline_px <= 0.0) return std::nullopt;
  const cv::Mat1f& rendered = surface.image().depth;
  const cv::Mat1f depth_px = depthOfEmpty(labels, rendered);
  std::optional<LocalMismatch> widest;
  for (int v = 0; v < depth_px.rows; ++v) {
    for (int u = 0; u < depth_px.cols; ++u) {
      if (depth_px(v, u) <= 0.0f) continue;
      const cv::Point pixel = labels.region.tl() + cv::Point(u, v);
      const double pixel_m = rendered(pixel) / surface.camera().fx;
      const double width_m = (2.0 * depth_px(v, u) - 1.0) * pixel_m;
      const double expected_m = std::hypot(usual_error_m, outline_px * pixel_m);
      if (width_m <= kSignificant * expected_m || (widest && width_m <= widest->width_m)) continue;
      if (width_m <= kSignificant * std::hypot(expected_m, deviationAt(surface, pixel, deviations))) continue;
      widest = {width_m, sideOf(pixel, surface.image().region)};
    }
  }
  return widest;
}

double imageScale(const Labels& labels, const PredictedSurface& surface) {
  if (labels.region.empty()) return 1.0;
  const cv::Mat1b body = labels.label == labels::kBody;
  const cv::Mat1b decided = body | (labels.label == labels::kBackground);
  const int covered = cv::countNonZero(decided & (surface.image().depth(labels.region) > 0.0f));
  return covered > 0 ? std::sqrt(static_cast<double>(cv::countNonZero(body)) / covered) : 1.0;
}

}  // namespace softbody
