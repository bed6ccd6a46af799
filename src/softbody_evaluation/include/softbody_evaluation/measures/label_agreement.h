#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>

namespace softbody::evaluation {

/// Of the pixels around the body: which of them have the true label. An unknown pixel is not right.
struct LabelReport {
  std::size_t frames = 0;  ///< with labels in the result, and a visible body
  std::size_t pixels = 0;  ///< of all regions
  double right = 0.0;      ///< share of them, 0..1
  double unknown = 0.0;    ///< likewise
  std::array<std::optional<double>, 4>
      of_class;  ///< share of right pixels by the true label; none: no pixel, or unknown
};

/// Counts over many frames.
class LabelAgreement {
 public:
  /// Compares the labels (as in pixel_labels.h) in the region: the bounding box of the true pixels of the
  /// body, and 24 px around it. Without such a pixel the frame does not count.
  /// @throw std::invalid_argument if the images differ in size.
  void add(const cv::Mat1b& truth, const cv::Mat1b& found);

  /// Nothing if no frame counts.
  std::optional<LabelReport> report() const;

 private:
  std::size_t frames_ = 0;
  std::array<std::array<std::size_t, 4>, 4> counts_ = {};  ///< pixels by true label and label
};

}  // namespace softbody::evaluation
