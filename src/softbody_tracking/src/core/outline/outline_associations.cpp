#include "outline/outline_associations.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "labels/depth_evidence.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr int kNormalWindow = 4;        // [px] each way; window in which the outline's direction is measured
constexpr double kContradiction = 3.0;  // [standard deviations] from which a line contradicts the prediction
constexpr std::size_t kFewestPixels = 8;   // of a line that can show where the body ends
constexpr double kLargestDeviation = 3.0;  // [px] with more, the end is nearly anywhere

/// Whether a surface ends at a pixel of this depth, given the depth beside it. Depth 0: no surface.
bool endsAt(float depth, float beside) {
  return depth > 0.0f && (beside <= 0.0f || beside - depth > kSurfaceEnds);
}

/// Whether a surface ends between two neighbouring pixels. Depth 0: nothing is rendered.
bool isStep(float a, float b) { return std::abs(a - b) > kSurfaceEnds; }

/// A straight outline beside a pixel.
struct OutlineEdge {
  Eigen::Vector2d outward;  ///< unit
  double distance;          ///< from the pixel's centre [px]
};

/// The outline that divides a window around a pixel as the surface does; nothing if the parts balance.
std::optional<OutlineEdge> edgeAt(const cv::Mat1f& rendered, const cv::Point& pixel) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int outside = 0;
  const float farthest = rendered(pixel) + static_cast<float>(kSurfaceEnds);
  for (int j = -kNormalWindow; j <= kNormalWindow; ++j) {
    const float* depth = rendered[pixel.y + j] + pixel.x;
    for (int i = -kNormalWindow; i <= kNormalWindow; ++i) {
      if (depth[i] > 0.0f && depth[i] <= farthest) continue;
      sum += Eigen::Vector2d(i, j);
      ++outside;
    }
  }
  const double length = sum.norm();
  if (length < 4 * kNormalWindow) return std::nullopt;
  const Eigen::Vector2d outward = sum / length;
  // A line near the centre divides the window's area in halves, plus its distance times its length in the
  // window.
  constexpr double kSide = 2 * kNormalWindow + 1;
  const double distance = (0.5 * kSide * kSide - outside) * outward.cwiseAbs().maxCoeff() / kSide;
  return OutlineEdge{outward, std::clamp(distance, 0.0, 1.0)};
}

/// Skips cuts, where two pieces touch and no outline shows. Also skips places whose normal is nearer to the
/// other direction of the pixel grid: they are sampled in that direction.
void addSample(const PredictedSurface& surface, const cv::Point& pixel, const cv::Point& across,
               std::vector<ContourSample>* samples) {
  const RasterImage& image = surface.image();
  const std::optional<OutlineEdge> edge = edgeAt(image.depth, pixel);
  if (!edge || edge->outward.dot(Eigen::Vector2d(across.x, across.y)) < std::sqrt(0.5)) return;
  const int triangle = image.triangle(pixel);
  if (surface.model().isAtCut(triangle)) return;
  const MaterialPoint place = surface.materialPoint(triangle, pixel);
  samples->push_back({pixel, edge->outward, edge->distance, place, surface.pieceOf(place),
                      surface.camera().unproject(pixel.x, pixel.y, image.depth(pixel))});
}

void addEnds(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b,
             std::vector<ContourSample>* samples) {
  const cv::Mat1f& rendered = surface.image().depth;
  const float depth_a = rendered(a), depth_b = rendered(b);
  if (endsAt(depth_a, depth_b)) addSample(surface, a, b - a, samples);
  if (endsAt(depth_b, depth_a)) addSample(surface, b, a - b, samples);
}

}  // namespace

OutlineSamples sampleOutline(const PredictedSurface& surface) {
  const cv::Mat1f& rendered = surface.image().depth;
  const auto [region, spacing] = contourGrid(surface.image());
  OutlineSamples result;
  result.covered_px = std::max(1, cv::countNonZero(rendered(surface.image().region)));
  result.spacing_px = spacing;
  // Rows of pixels cross the steep parts of the outline, columns cross the flat parts.
  for (int v = region.y + spacing / 2; v < region.br().y; v += spacing) {
    const float* row = rendered[v];
    for (int u = region.x; u <= region.br().x; ++u) {
      if (isStep(row[u - 1], row[u])) addEnds(surface, {u - 1, v}, {u, v}, &result.samples);
    }
  }
  for (int v = region.y; v <= region.br().y; ++v) {
    const float *above = rendered[v - 1], *row = rendered[v];
    for (int u = region.x + spacing / 2; u < region.br().x; u += spacing) {
      if (isStep(above[u], row[u])) addEnds(surface, {u, v - 1}, {u, v}, &result.samples);
    }
  }
  return result;
}

OutlineAssociations associateOutline(const RgbdFrame& frame, const RasterImage& image,
                                     const OutlineSamples& samples, const RigidMotions& motions,
                                     const Labels& labels, const ContourWeight& weight) {
  OutlineAssociations found;
  OutlineLine line(frame, image.depth, labels);
  double apart_px = 0.0, outside_px = 0.0;
  std::vector<double> deviations;
  for (const ContourSample& sample : samples.samples) {
    const Eigen::Vector3d predicted = motions[sample.piece] * sample.position;
    if (!(predicted.z() > 0.0)) continue;
    const std::vector<LinePixel>& pixels = line.across(sample, predicted);
    if (pixels.size() < kFewestPixels) continue;
    const double error_px = labels.error_m * frame.camera.fx / predicted.z();
    const ContourPosterior found_end = contourPosterior(pixels, predictionVariance(error_px));
    const ContourEnd& end = found_end.end;
    if (!found_end.beyond && !std::isinf(found_end.added.variance) && !line.endsOtherPart(found_end.together))
      found.associations.push_back(
          contourAssociation(frame.camera, sample, predicted, found_end.added, weight, samples.spacing_px));
    if (end.variance > kLargestDeviation * kLargestDeviation) continue;
    deviations.push_back(std::sqrt(end.variance));
    if (found_end.doubt <= kContradiction) continue;
    const double off_px = found_end.beyond ? std::copysign(line.reach(), end.mean) : end.mean;
    apart_px += std::abs(off_px);
    outside_px += off_px;
  }
  const double length_px = static_cast<double>(samples.samples.size()) * samples.spacing_px;
  if (deviations.empty()) return found;
  const double area_per_px = length_px / static_cast<double>(deviations.size()) / samples.covered_px;
  found.disagreement = apart_px * area_per_px;
  found.excess = outside_px * area_per_px;
  found.deviation_px = median(&deviations);
  return found;
}

}  // namespace softbody
