#pragma once

#include <Eigen/Core>
#include <vector>

#include "labels/labels.h"
#include "outline/contour_association.h"
#include "outline/contour_posterior.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// The body's evidence along a line across its predicted outline, from colour and depth of each pixel.
class OutlineLine {
 public:
  /// @param rendered depth of the prediction, from which the sample was taken.
  OutlineLine(const RgbdFrame& frame, const cv::Mat1f& rendered, const Labels& labels);

  /// @param moved the sample's present position, camera frame [m]. @return distances refer to the predicted
  /// outline beside the moved sample. Empty if the line leaves the image, or if something nearer hides where
  /// the body should end.
  const std::vector<LinePixel>& across(const ContourSample& sample, const Eigen::Vector3d& moved);

  /// How far the end of the body is searched, each way [px]: an angle, so that it is the same for every image
  /// size.
  int reach() const { return reach_; }

  /// Whether the body just inside this end is farther than the surface at the predicted outline: the end of
  /// another part, for example of a side that has come into view. Refers to the last line across().
  /// @param end its distance from the predicted outline [px].
  bool endsOtherPart(double end) const;

 private:
  const RgbdFrame& frame_;
  int reach_;
  const cv::Mat1f& rendered_;
  const Labels& labels_;
  std::vector<LinePixel> pixels_;
  std::vector<double> farther_by_;  ///< of each pixel: measured minus predicted depth [m]; 0: not measured
};

}  // namespace softbody
