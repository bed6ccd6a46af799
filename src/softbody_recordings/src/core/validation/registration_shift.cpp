#include "softbody_recordings/validation/registration_shift.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace softbody::validation {
namespace {

constexpr int kWidth = 320;             // of the compared images [px]
constexpr int kMargin = 32;             // largest shift that is found [px of the compared images]
constexpr double kStep = 0.05;          // an edge of an object: depth behind it is larger by this share
constexpr int kFewestEdgePixels = 100;  // fewer say nothing
constexpr double kStrongestEdge =
    60.0;  // of grey: a texture with more contrast must not outweigh the objects

cv::Mat1f colorEdges(const cv::Mat3b& color, const cv::Size& size) {
  cv::Mat small, grey, dx, dy;
  cv::resize(color, small, size, 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey, dx, CV_32F, 1, 0);
  cv::Sobel(grey, dy, CV_32F, 0, 1);
  cv::Mat1f edges;
  cv::magnitude(dx, dy, edges);
  edges = cv::min(edges, kStrongestEdge);
  cv::GaussianBlur(edges, edges, cv::Size(5, 5), 0.0);
  return edges;
}

/// The nearer side of steps in depth, across a strip without depth, too.
cv::Mat1f depthEdges(const cv::Mat1f& depth, const cv::Size& size) {
  cv::Mat1f small, behind;
  cv::resize(depth, small, size, 0.0, 0.0, cv::INTER_NEAREST);
  cv::patchNaNs(small, 0.0);
  cv::dilate(small, behind, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(7, 7)));
  const cv::Mat1b step = (small > 0.0f) & (behind > (1.0 + kStep) * small);
  if (cv::countNonZero(step) < kFewestEdgePixels) return {};
  cv::Mat1f edges;
  step.convertTo(edges, CV_32F);
  cv::GaussianBlur(edges, edges, cv::Size(5, 5), 0.0);
  return edges;
}

}  // namespace

void RegistrationShiftEstimator::add(const cv::Mat3b& color, const cv::Mat1f& depth) {
  if (color.size() != depth.size() || color.cols < 2 * kMargin) return;
  const double scale = std::max(1.0, static_cast<double>(color.cols) / kWidth);
  const cv::Size size(cvRound(color.cols / scale), cvRound(color.rows / scale));
  if (size.width <= 3 * kMargin || size.height <= 3 * kMargin) return;
  const cv::Mat1f edges = depthEdges(depth, size);
  if (edges.empty()) return;
  const cv::Rect inner(kMargin, kMargin, size.width - 2 * kMargin, size.height - 2 * kMargin);
  if (cv::countNonZero(edges(inner)) < kFewestEdgePixels) return;
  cv::Mat1f correlation;
  cv::matchTemplate(colorEdges(color, size), edges(inner), correlation, cv::TM_CCOEFF_NORMED);
  if (sum_.empty()) sum_ = cv::Mat1f::zeros(correlation.size());
  if (sum_.size() != correlation.size()) return;
  sum_ += correlation;
  scale_ = scale;
  ++images_;
}

std::optional<RegistrationShift> RegistrationShiftEstimator::shift() const {
  if (images_ == 0) return std::nullopt;
  double best = 0.0;
  cv::Point at;
  cv::minMaxLoc(sum_, nullptr, &best, nullptr, &at);
  // An edge's own width, and the nearer side of depth's edges, move the best place by a few pixels.
  double unshifted = 0.0;
  cv::minMaxLoc(sum_(cv::Rect(kMargin - 2, kMargin - 2, 5, 5)), nullptr, &unshifted);
  return RegistrationShift{cv::Point2d(at.x - kMargin, at.y - kMargin) * scale_, best / images_,
                           unshifted / images_};
}

}  // namespace softbody::validation
