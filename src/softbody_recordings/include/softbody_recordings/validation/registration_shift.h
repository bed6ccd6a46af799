#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace softbody::validation {

/// By how much depth lies beside colour in the image.
struct RegistrationShift {
  cv::Point2d pixels;     ///< from depth's edges to colour's
  double similarity = 0;  ///< correlation of the edges with this shift, -1 to 1
  double unshifted = 0;   ///< the same without a shift
};

/// Compares the edges of objects in depth with the edges in colour, over several images of a recording.
class RegistrationShiftEstimator {
 public:
  /// @param depth in any unit, of color's size; 0 or NaN: not measured.
  void add(const cv::Mat3b& color, const cv::Mat1f& depth);
  /// Nothing without images, or without edges in them.
  std::optional<RegistrationShift> shift() const;

 private:
  cv::Mat1f sum_;       ///< correlation by shift
  double scale_ = 1.0;  ///< pixels of the recording in one of `sum_`
  int images_ = 0;
};

}  // namespace softbody::validation
