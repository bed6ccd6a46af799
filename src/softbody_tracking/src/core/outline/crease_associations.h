#pragma once

#include <vector>

#include "outline/contour_association.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// Associates the predicted creases, where two sides of the body meet at an angle, with the edges in the
/// image that light and shadow make of them. On a body of one colour only they show where along its surface a
/// point lies.
class CreaseAssociator {
 public:
  /// @param volume_edge_m mean edge of the tets; config.weight is the weight per edge.
  CreaseAssociator(const OutlineConfig& config, double volume_edge_m)
      : config_(config), volume_edge_m_(volume_edge_m) {}

  /// Samples the creases of a surface that has just been rendered.
  void sample(const PredictedSurface& surface);

  /// Appends the creases that the frame shows. @param surface as sampled. @param motions of the body's pieces
  /// since then.
  void associate(const RgbdFrame& frame, const PredictedSurface& surface, const RigidMotions& motions,
                 std::vector<Association>* associations);

 private:
  /// A sample, and the normals of the sides before and behind it.
  struct Crease : ContourSample {
    Eigen::Vector3d before, behind;
  };

  void addSample(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b);
  bool collect(const RgbdFrame& frame, const PredictedSurface& surface, const Crease& crease,
               const Eigen::Vector3d& moved);

  OutlineConfig config_;
  double volume_edge_m_;
  double spacing_px_ = 1.0;
  std::vector<Crease> samples_;
  std::vector<double> distances_;       ///< of the pixels on a line from the predicted crease [px]
  std::vector<Eigen::Array3d> colors_;  ///< of these pixels
  std::vector<LinePixel> line_;
};

}  // namespace softbody
