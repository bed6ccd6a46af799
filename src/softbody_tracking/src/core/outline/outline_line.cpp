#include "outline/outline_line.h"

#include <algorithm>
#include <cmath>

#include "labels/depth_evidence.h"

namespace softbody {
namespace {

// Pixels beside the predicted outline that something nearer must not cover.
constexpr double kUncovered = 3.0;
// Where the depth of an end is read [px inside it]; nearer to it, depth mixes body and background.
constexpr double kInside = 4.0, kRagged = 1.0;

/// Log odds of a part of the body against another part behind it.
double logOddsBefore(double behind, double measured, double predicted) {
  return std::clamp<double>(DepthEvidence::logOddsBefore(behind, measured, predicted), -kDepthLimit,
                            kDepthLimit);
}

}  // namespace

OutlineLine::OutlineLine(const RgbdFrame& frame, const cv::Mat1f& rendered, const Labels& labels)
    : frame_(frame), reach_(cvRound(kReach * frame.camera.fx)), rendered_(rendered), labels_(labels) {
  pixels_.reserve(static_cast<std::size_t>(2 * reach_ + 1));
  farther_by_.reserve(pixels_.capacity());
}

bool OutlineLine::endsOtherPart(double end) const {
  int measured = 0, farther = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i].distance < end - kInside || pixels_[i].distance > end - kRagged || farther_by_[i] == 0.0)
      continue;
    ++measured;
    farther += farther_by_[i] > kBehindSurface ? 1 : 0;
  }
  return 2 * farther > measured;
}

const std::vector<LinePixel>& OutlineLine::across(const ContourSample& sample, const Eigen::Vector3d& moved) {
  pixels_.clear();
  farther_by_.clear();
  const Eigen::Vector2d start = frame_.camera.project(moved), &outward = sample.outward;
  const Eigen::Vector2d rendered_start(sample.pixel.x, sample.pixel.y);
  const cv::Rect image(cv::Point(), frame_.depth.size());
  const double farther_by = moved.z() - sample.position.z();
  double body = 0.0;  // predicted depth of the body at the pixel
  for (int step = -reach_; step <= reach_; ++step) {
    const cv::Point pixel(cvRound(start.x() + step * outward.x()), cvRound(start.y() + step * outward.y()));
    const cv::Point rendered_pixel(cvRound(rendered_start.x() + step * outward.x()),
                                   cvRound(rendered_start.y() + step * outward.y()));
    if (!image.contains(pixel) || !image.contains(rendered_pixel)) return pixels_.clear(), pixels_;
    const double distance = (Eigen::Vector2d(pixel.x, pixel.y) - start).dot(outward) - sample.to_edge;
    const double predicted = rendered_(rendered_pixel) > 0.0f ? rendered_(rendered_pixel) + farther_by : 0.0;
    // On a limb narrower than the reach the line begins at its other side: behind that nothing of it shows.
    const bool begins = step <= 0 && (predicted <= 0.0 || body - predicted > kSurfaceEnds);
    if (begins) pixels_.clear(), farther_by_.clear();
    body = step <= 0 ? predicted : moved.z();
    if (begins || (!pixels_.empty() && distance <= pixels_.back().distance)) continue;
    const double measured = frame_.depth(pixel);
    const bool covered = labels_.at(pixel) == labels::kOccluder;
    if (covered && std::abs(distance) < kUncovered) return pixels_.clear(), pixels_;
    const bool before_other_part = step > 0 && predicted > 0.0 && measured > 0.0;
    const double log_odds = covered             ? 0.0
                            : before_other_part ? logOddsBefore(predicted, measured, body)
                                                : labels_.logOddsAt(pixel);
    pixels_.push_back({distance, log_odds});
    farther_by_.push_back(measured > 0.0 ? measured - body : 0.0);
  }
  return pixels_;
}

}  // namespace softbody
