#include "softbody_evaluation/measures/silhouette.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace softbody::evaluation {
namespace {

constexpr int kReach = 15;  // largest distance of the body from the model [px]

}  // namespace

double intersectionOverUnion(const cv::Mat1b& a, const cv::Mat1b& b) {
  if (a.size() != b.size()) {
    throw std::invalid_argument(fmt::format("silhouettes of {}x{} and {}x{} pixels cannot be compared",
                                            a.cols, a.rows, b.cols, b.rows));
  }
  const int common = cv::countNonZero(a & b), either = cv::countNonZero(a | b);
  return either == 0 ? 1.0 : static_cast<double>(common) / either;
}

cv::Mat1b silhouette(const cv::Mat1f& rendered_depth) { return rendered_depth > 0.0f; }

cv::Mat1b measuredSilhouette(const cv::Mat1f& measured, const cv::Mat1f& model, double margin_m) {
  const cv::Mat1b covered = silhouette(model);
  if (cv::countNonZero(covered) == 0) return cv::Mat1b::zeros(measured.size());
  double nearest = 0.0, farthest = 0.0;
  cv::minMaxLoc(model, &nearest, &farthest, nullptr, nullptr, covered);
  cv::Mat1b around;
  cv::dilate(covered, around, cv::Mat1b::ones(2 * kReach + 1, 2 * kReach + 1));
  return (measured >= nearest - margin_m) & (measured <= farthest + margin_m) & around;
}

SilhouetteReport summarizeSilhouettes(const std::vector<double>& values, bool against_truth) {
  SilhouetteReport report;
  report.against_truth = against_truth;
  report.frames = values.size();
  report.values = values;
  if (values.empty()) return report;
  report.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  report.worst = *std::min_element(values.begin(), values.end());
  return report;
}

}  // namespace softbody::evaluation
