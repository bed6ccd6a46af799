#include "status/disagreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "prediction/memory.h"
#include "prediction/place_deviation.h"
#include "softbody_common/statistics/median.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

// Standard deviations from which what shows beyond the outline contradicts the prediction.
constexpr double kSignificant = 5.0;
// 90 % of the distances in space are at most so many standard deviations, which count all three directions.
constexpr double kBound90 = 1.44354;
// Every second pixel of every second row is compared: depth is smooth.
constexpr int kStep = 2;
// Side of a patch [such pixels]: wide beside the error of an outline.
constexpr int kPatch = 7;
// Something farther off is another surface [m].
constexpr float kFarthest = 0.05f;

/// @param pixel in the image.
std::string sideOf(const cv::Point& pixel, const cv::Rect& body) {
  const double right = (pixel.x - body.x) / static_cast<double>(body.width) - 0.5;
  const double down = (pixel.y - body.y) / static_cast<double>(body.height) - 0.5;
  if (std::abs(right) >= std::abs(down)) return right < 0.0 ? "left" : "right";
  return down < 0.0 ? "upper" : "lower";
}

/// For each pixel of a patch its distance from the nearest pixel outside of all patches [px]; 0 elsewhere.
cv::Mat1f depthInside(const cv::Mat1b& patches) {
  cv::Mat1b framed;
  cv::copyMakeBorder(patches, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1f distance;
  cv::distanceTransform(framed, distance, cv::DIST_L2, 3);
  return distance(cv::Rect({1, 1}, patches.size()));
}

/// The widest circle within the patches.
struct Widest {
  double width_px = 0.0;
  cv::Point center;
};

Widest widestOf(const cv::Mat1b& patches) {
  Widest widest;
  double inside_px = 0.0;
  cv::minMaxLoc(depthInside(patches), nullptr, &inside_px, nullptr, &widest.center);
  widest.width_px = std::max(0.0, 2.0 * inside_px - 1.0);
  return widest;
}

/// The widest patch of background on the rendered body.
Disagreement background(const ComparedBody& body) {
  const cv::Mat1f& rendered = body.surface.image().depth;
  const cv::Rect region = body.labels.region & body.surface.image().region;
  if (region.empty()) return {};
  const cv::Mat1b label = body.labels.label(region - body.labels.region.tl());
  cv::Mat1b patches;
  cv::bitwise_and(label == labels::kBackground, rendered(region) > 0.0f, patches);
  const Widest widest = widestOf(patches);
  const cv::Point pixel = region.tl() + widest.center;
  return {Disagreement::Kind::kBackground, widest.width_px * rendered(pixel) / body.surface.camera().fx,
          sideOf(pixel, body.surface.image().region)};
}

/// The pixel of the rendered body that is nearest to another one.
cv::Point nearestRendered(const cv::Mat1f& rendered, const cv::Rect& region, const cv::Point& to) {
  cv::Point nearest = to;
  int least = std::numeric_limits<int>::max();
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) {
      const cv::Point way = cv::Point(u, v) - to;
      if (rendered(v, u) <= 0.0f || way.dot(way) >= least) continue;
      least = way.dot(way);
      nearest = {u, v};
    }
  }
  return nearest;
}

/// The widest patch of body beyond the rendered one, if it is significant.
Disagreement beyond(const ComparedBody& body) {
  const cv::Rect& region = body.labels.region;
  const cv::Mat1f& rendered = body.surface.image().depth;
  cv::Mat1b patches;
  cv::bitwise_and(body.labels.label == labels::kBody, rendered(region) <= 0.0f, patches);
  const Widest widest = widestOf(patches);
  if (widest.width_px <= kSignificant * body.outline_px) return {};
  const cv::Point pixel = region.tl() + widest.center;
  const cv::Point beside = nearestRendered(rendered, region, pixel);
  if (rendered(beside) <= 0.0f) return {};
  const double pixel_m = rendered(beside) / body.surface.camera().fx;
  const double width_m = widest.width_px * pixel_m;
  const MaterialPoint place = body.surface.materialPoint(body.surface.image().triangle(beside), beside);
  const double expected_m =
      std::hypot(body.outline_px * pixel_m, deviationAt(place, body.surface.volume(), body.deviations));
  if (width_m <= kSignificant * expected_m) return {};
  return {Disagreement::Kind::kBeyond, width_m, sideOf(pixel, body.surface.image().region)};
}

/// Sums over patches of the surface, around each second pixel of the rendering.
struct PatchSums {
  cv::Point origin;    ///< pixel of the first one
  cv::Mat1f behind_m;  ///< of measured depth behind the surface, along its normal [m]
  cv::Mat1f count;     ///< of pixels
};

/// Cosine between the rendered surface's normal and the line of sight, by the depth of the pixels around.
float cosineAt(const cv::Mat1f& rendered, const cv::Point& pixel, float focal_px) {
  const float* row = rendered[pixel.y] + pixel.x;
  const auto step = static_cast<std::ptrdiff_t>(rendered.step1());
  const float slope = focal_px / (2.0f * row[0]);
  const float right = slope * (row[1] - row[-1]), down = slope * (row[step] - row[-step]);
  return 1.0f / std::sqrt(1.0f + right * right + down * down);
}

PatchSums patchSums(const ComparedBody& body) {
  const cv::Mat1f& rendered = body.surface.image().depth;
  const cv::Rect region = body.surface.image().region & cv::Rect({1, 1}, rendered.size() - cv::Size(2, 2));
  const cv::Size size((region.width + kStep - 1) / kStep, (region.height + kStep - 1) / kStep);
  PatchSums sums{region.tl(), cv::Mat1f(size, 0.0f), cv::Mat1f(size, 0.0f)};
  const auto focal_px = static_cast<float>(body.surface.camera().fx);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const cv::Point pixel = region.tl() + kStep * cv::Point(u, v);
      const float predicted = rendered(pixel), measured = body.depth(pixel);
      if (!(predicted > 0.0f && measured > 0.0f) || body.labels.at(pixel) != labels::kBody) continue;
      sums.behind_m(v, u) =
          cosineAt(rendered, pixel, focal_px) * std::clamp(measured - predicted, -kFarthest, kFarthest);
      sums.count(v, u) = 1.0f;
    }
  }
  for (cv::Mat1f* sum : {&sums.behind_m, &sums.count})
    cv::boxFilter(*sum, *sum, -1, {kPatch, kPatch}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return sums;
}

/// The patch of depth that is farthest behind the surface, on average. At least half of a patch shows the
/// body.
Disagreement behind(const ComparedBody& body) {
  const PatchSums sums = patchSums(body);
  cv::Mat1f means;
  cv::divide(sums.behind_m, sums.count, means);
  means.setTo(0.0f, sums.count < 0.5 * kPatch * kPatch);
  double largest = 0.0;
  cv::Point place;
  cv::minMaxLoc(means, nullptr, &largest, nullptr, &place);
  return {Disagreement::Kind::kBehind, largest,
          sideOf(sums.origin + kStep * place, body.surface.image().region)};
}

}  // namespace

Disagreement largestDisagreement(const ComparedBody& body) {
  if (body.labels.region.empty() || body.surface.image().region.empty()) return {};
  Disagreement largest = background(body);
  for (const Disagreement& other : {behind(body), beyond(body)})
    if (other.error_m > largest.error_m) largest = other;
  return largest;
}

const Disagreement& MeanDisagreement::add(const Disagreement& newest, Nanoseconds stamp) {
  const double elapsed_s = stamp_ ? seconds(stamp - *stamp_) : std::numeric_limits<double>::infinity();
  stamp_ = stamp;
  const double error_m = mean_.error_m + newestShare(elapsed_s, kMemory_s) * (newest.error_m - mean_.error_m);
  if (newest.error_m >= error_m) mean_ = newest;
  mean_.error_m = error_m;
  return mean_;
}

double medianBound(const std::vector<Association>& shown, const TetTopology& volume,
                   const std::vector<float>& deviations) {
  if (deviations.empty()) return 0.0;
  std::vector<double> at;
  at.reserve(shown.size());
  for (const Association& association : shown)
    at.push_back(deviationAt(association.place, volume, deviations));
  return kBound90 * median(&at);
}

double imageScale(const Labels& labels, const PredictedSurface& surface) {
  if (labels.region.empty()) return 1.0;
  const cv::Mat1b body = labels.label == labels::kBody;
  const cv::Mat1b decided = body | (labels.label == labels::kBackground);
  const int covered = cv::countNonZero(decided & (surface.image().depth(labels.region) > 0.0f));
  return covered > 0 ? std::sqrt(static_cast<double>(cv::countNonZero(body)) / covered) : 1.0;
}

}  // namespace softbody
