#include "softbody_evaluation/measures/label_agreement.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "softbody_common/images/pixel_labels.h"

namespace softbody::evaluation {
namespace {

constexpr int kAround = 24;  // [px]

double shareOf(std::size_t part, std::size_t all) {
  return static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

void LabelAgreement::add(const cv::Mat1b& truth, const cv::Mat1b& found) {
  if (truth.size() != found.size()) {
    throw std::invalid_argument(fmt::format("label images of {}x{} and {}x{} pixels cannot be compared",
                                            truth.cols, truth.rows, found.cols, found.rows));
  }
  const cv::Rect body = cv::boundingRect(truth == labels::kBody);
  if (body.empty()) return;
  ++frames_;
  const cv::Rect around(body.tl() - cv::Point(kAround, kAround), body.br() + cv::Point(kAround, kAround));
  const cv::Rect region = around & cv::Rect({}, truth.size());
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) {
      const std::size_t expected = truth(v, u), label = found(v, u);
      if (expected != labels::kUnknown && expected < counts_.size())
        ++counts_[expected][label < counts_.size() ? label : labels::kUnknown];
    }
  }
}

std::optional<LabelReport> LabelAgreement::report() const {
  if (frames_ == 0) return std::nullopt;
  LabelReport report;
  report.frames = frames_;
  std::size_t right = 0, unknown = 0;
  for (std::size_t label = labels::kBackground; label < counts_.size(); ++label) {
    std::size_t pixels = 0;
    for (const std::size_t count : counts_[label]) pixels += count;
    if (pixels > 0) report.of_class[label] = shareOf(counts_[label][label], pixels);
    report.pixels += pixels;
    right += counts_[label][label];
    unknown += counts_[label][labels::kUnknown];
  }
  report.right = shareOf(right, report.pixels);
  report.unknown = shareOf(unknown, report.pixels);
  return report;
}

}  // namespace softbody::evaluation
