#include "depth/outline_associations.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "softbody_common/target_limits.h"

namespace softbody {
namespace {

constexpr int kWantedSamples = 160;  // wanted number of samples around the body
constexpr int kBorder = 8;           // [px] at the image border an outline may be the image's own
constexpr int kNormalWindow = 4;     // [px] each way; window in which the outline's direction is measured
constexpr double kDeadZone = 2.0;    // [px] inaccuracy of depth at edges
constexpr int kReach = 20;           // [px] each way; how far the body's end is searched
constexpr int kMaxGap = 4;           // [px] longest gap without depth
constexpr float kFarther = 0.02f;  // [m] the background is at least this far behind the body; far above noise
constexpr double kTolerance = 0.015;   // [m] between prediction and body at a pixel
constexpr double kContinuity = 0.008;  // [m] largest step between neighbouring pixels of the body
constexpr double kMaxOutward = 0.012;  // [m] what reaches further may be a hand that touches the body
constexpr double kMaxPull = 0.01;      // [m] a larger error does not pull more

/// Whether a surface ends at a pixel of this depth, given the depth beside it. Depth 0: no surface.
bool endsAt(float depth, float beside) {
  return depth > 0.0f && (beside <= 0.0f || beside - depth > kFarther);
}

/// Whether a surface ends between two neighbouring pixels. Depth 0: nothing is rendered.
bool isStep(float a, float b) { return std::abs(a - b) > kFarther; }

/// Unit vector from the surface's pixels towards the other pixels of a window; nothing if they balance.
std::optional<Eigen::Vector2d> outwardAt(const cv::Mat1f& rendered, const cv::Point& pixel) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const float farthest = rendered(pixel) + kFarther;
  for (int j = -kNormalWindow; j <= kNormalWindow; ++j) {
    const float* depth = rendered[pixel.y + j] + pixel.x;
    for (int i = -kNormalWindow; i <= kNormalWindow; ++i) {
      if (depth[i] <= 0.0f || depth[i] > farthest) sum += Eigen::Vector2d(i, j);
    }
  }
  const double length = sum.norm();
  if (length < 4 * kNormalWindow) return std::nullopt;
  return sum / length;
}

/// Pixels along the normal of the predicted outline; step 0 is on the outline, positive steps lead outwards.
class OutlineWalk {
 public:
  OutlineWalk(const RgbdFrame& frame, const RasterImage& image, const ColorModel& colors,
              const OutlineSample& sample, const Eigen::Vector3d& moved)
      : frame_(frame),
        rendered_(image.depth),
        colors_(colors),
        rendered_start_(sample.pixel.x, sample.pixel.y),
        start_(frame.camera.project(moved)),
        outward_(sample.outward),
        depth_(moved.z()),
        farther_by_(moved.z() - sample.position.z()) {}

  const Eigen::Vector2d& start() const { return start_; }

  /// Distance of the body's last pixel from the predicted outline [px], positive outside; nothing if the
  /// frame does not show where the body ends.
  std::optional<double> bodyEnd() const {
    int body = 0;
    for (Shown shown; (shown = shownAt(body)) != Shown::kBody; --body) {
      if (shown == Shown::kOther || body == -kReach || isOtherSide(body - 1)) return std::nullopt;
    }
    for (int step = body + 1; step <= kReach && step - body <= kMaxGap + 1; ++step) {
      if (!isInside(step)) return std::nullopt;
      const double depth = measuredAt(step), farther = depth - measuredAt(body);
      if (depth <= 0.0) continue;
      if (farther > kFarther) return endBetween(distanceTo(body), distanceTo(step));
      if (!continues(farther, body, step)) return std::nullopt;
      body = step;
    }
    return std::nullopt;
  }

 private:
  enum class Shown { kBody, kNoBody, kOther };

  cv::Point pixelAt(int step) const {
    return {cvRound(start_.x() + step * outward_.x()), cvRound(start_.y() + step * outward_.y())};
  }
  double distanceTo(int step) const {
    const cv::Point pixel = pixelAt(step);
    return (Eigen::Vector2d(pixel.x, pixel.y) - start_).dot(outward_);
  }
  bool isInside(int step) const {
    const cv::Point pixel = pixelAt(step);
    return pixel.x >= kBorder && pixel.y >= kBorder && pixel.x < frame_.depth.cols - kBorder &&
           pixel.y < frame_.depth.rows - kBorder;
  }
  bool hasBodyColor(int step) const { return colors_.belongs(frame_.color(pixelAt(step))); }
  double measuredAt(int step) const { return frame_.depth(pixelAt(step)); }

  /// Predicted depth; 0 if the prediction does not cover the pixel.
  double predictedAt(int step) const {
    const cv::Point pixel(cvRound(rendered_start_.x() + step * outward_.x()),
                          cvRound(rendered_start_.y() + step * outward_.y()));
    if (!cv::Rect(cv::Point(), rendered_.size()).contains(pixel)) return 0.0;
    return rendered_(pixel) > 0.0f ? rendered_(pixel) + farther_by_ : 0.0;
  }

  /// Whether the prediction ends there on its other side, as on a limb narrower than the reach.
  bool isOtherSide(int step) const {
    return isStep(static_cast<float>(predictedAt(step)), static_cast<float>(predictedAt(step + 1)));
  }

  /// What the frame shows at a pixel that the prediction covers.
  Shown shownAt(int step) const {
    const double predicted = predictedAt(step);
    if (!isInside(step) || predicted <= 0.0) return Shown::kOther;
    const double depth = measuredAt(step);
    if (depth <= 0.0 || depth - predicted > kTolerance) return Shown::kNoBody;
    return predicted - depth < kTolerance && hasBodyColor(step) ? Shown::kBody : Shown::kOther;
  }

  /// In a gap without depth the body may end anywhere. The end nearest to the prediction is taken.
  static double endBetween(double body, double behind) {
    return body >= 0.0 ? body : std::min(0.0, std::max(body, behind - 1.0));
  }

  /// Whether the body continues from one pixel to another.
  bool continues(double farther, int from, int to) const {
    return std::abs(farther) < (to - from) * kContinuity && hasBodyColor(to) && !isOtherPart(to);
  }

  /// Whether the frame shows the part of the body that the prediction has behind the outline.
  bool isOtherPart(int step) const {
    const double predicted = predictedAt(step);
    return step > 0 && predicted - depth_ > kFarther && std::abs(measuredAt(step) - predicted) < kTolerance;
  }

  const RgbdFrame& frame_;
  const cv::Mat1f& rendered_;
  const ColorModel& colors_;
  Eigen::Vector2d rendered_start_, start_, outward_;
  double depth_;
  double farther_by_;  ///< change of the depth since it was rendered [m]
};

/// Nothing if the outline agrees with the frame, or if the frame does not show where the body ends.
std::optional<Association> associateSample(const RgbdFrame& frame, const RasterImage& image,
                                           const OutlineSample& sample, const Eigen::Isometry3d& motion,
                                           const ColorModel& colors) {
  Association association;
  association.place = sample.place;
  association.piece = sample.piece;
  association.predicted = motion * sample.position;
  const double z = association.predicted.z();
  if (!(z > 0.0)) return std::nullopt;
  const OutlineWalk walk(frame, image, colors, sample, association.predicted);
  const std::optional<double> end = walk.bodyEnd();
  if (!end || std::abs(*end) <= kDeadZone) return std::nullopt;
  const double pixels_per_m = frame.camera.fx / z, most = kMaxPull * pixels_per_m;
  if (*end > kMaxOutward * pixels_per_m) return std::nullopt;
  const double pull = std::copysign(std::min(std::abs(*end) - kDeadZone, most), *end);
  const Eigen::Vector2d pixel = walk.start() + pull * sample.outward;
  association.measured = frame.camera.unproject(pixel.x(), pixel.y(), z);
  // Normal to the plane through the camera and the outline.
  const Eigen::Vector3d along(-sample.outward.y() / frame.camera.fx, sample.outward.x() / frame.camera.fy,
                              0.0);
  association.normal = association.measured.cross(along).normalized();
  return association;
}

}  // namespace

void OutlineAssociator::sample(const PredictedSurface& surface) {
  samples_.clear();
  if (config_.weight <= 0.0) return;
  const cv::Mat1f& rendered = surface.image().depth;
  const cv::Rect region = surface.image().region & cv::Rect(kBorder, kBorder, rendered.cols - 2 * kBorder,
                                                            rendered.rows - 2 * kBorder);
  spacing_px_ = std::max(1, 2 * (region.width + region.height) / kWantedSamples);
  // Rows of pixels cross the steep parts of the outline, columns cross the flat parts.
  for (int v = region.y + spacing_px_ / 2; v < region.br().y; v += spacing_px_) {
    const float* row = rendered[v];
    for (int u = region.x; u <= region.br().x; ++u) {
      if (isStep(row[u - 1], row[u])) addEnds(surface, {u - 1, v}, {u, v});
    }
  }
  for (int v = region.y; v <= region.br().y; ++v) {
    const float *above = rendered[v - 1], *row = rendered[v];
    for (int u = region.x + spacing_px_ / 2; u < region.br().x; u += spacing_px_) {
      if (isStep(above[u], row[u])) addEnds(surface, {u, v - 1}, {u, v});
    }
  }
}

void OutlineAssociator::addEnds(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b) {
  const cv::Mat1f& rendered = surface.image().depth;
  const float depth_a = rendered(a), depth_b = rendered(b);
  if (endsAt(depth_a, depth_b)) addSample(surface, a, b - a);
  if (endsAt(depth_b, depth_a)) addSample(surface, b, a - b);
}

/// Skips cuts, where two pieces touch and no outline shows. Also skips places whose normal is nearer to the
/// other direction of the pixel grid: they are sampled in that direction.
void OutlineAssociator::addSample(const PredictedSurface& surface, const cv::Point& pixel,
                                  const cv::Point& across) {
  const RasterImage& image = surface.image();
  const std::optional<Eigen::Vector2d> outward = outwardAt(image.depth, pixel);
  if (!outward || outward->dot(Eigen::Vector2d(across.x, across.y)) < std::sqrt(0.5)) return;
  const int triangle = image.triangle(pixel);
  if (surface.isAtCut(triangle)) return;
  const MaterialPoint place = surface.materialPoint(triangle, pixel);
  samples_.push_back({pixel, *outward, place, surface.pieceOf(place),
                      surface.camera().unproject(pixel.x, pixel.y, image.depth(pixel))});
}

const std::vector<Association>& OutlineAssociator::associate(const RgbdFrame& frame, const RasterImage& image,
                                                             const RigidMotions& motions,
                                                             const ColorModel& colors) {
  found_.clear();
  for (const OutlineSample& sample : samples_) {
    std::optional<Association> association =
        associateSample(frame, image, sample, motions[sample.piece], colors);
    if (!association) continue;
    const double spacing_m = spacing_px_ * association->predicted.z() / frame.camera.fx;
    association->weight = std::min(config_.weight * spacing_m / volume_edge_m_, kLargestTargetWeight);
    found_.push_back(*association);
  }
  return found_;
}

}  // namespace softbody
