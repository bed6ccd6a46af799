#pragma once

#include <vector>

#include "prediction/association.h"
#include "prediction/color_model.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// A pixel on the predicted outline: beside it the image shows something farther, or nothing.
struct OutlineSample {
  cv::Point pixel;
  Eigen::Vector2d outward;  ///< unit, in the image
  MaterialPoint place;
  std::uint32_t piece = 0;   ///< of the body
  Eigen::Vector3d position;  ///< camera frame [m]
};

/// Associates the predicted outline with the body's outline in the frame, along the outline's normal in the
/// image (Harris and Stennett 1990, RAPID). It corrects errors perpendicular to the line of sight, which
/// depth along the rays does not show:
/// - If the camera sees something clearly farther where the prediction is, the outline is pulled in.
/// - If the body continues beyond the prediction, without a step in depth and in its own colour, up to a
///   clear step backwards, the outline is pulled out. Errors of up to two pixels are ignored, because depth
///   at edges is not more accurate. Samples are ignored if something nearer, another colour, a gap in depth
///   or the image border lies in between.
class OutlineAssociator {
 public:
  /// @param volume_edge_m mean edge of the tets; config.weight is the weight per edge.
  OutlineAssociator(const OutlineConfig& config, double volume_edge_m)
      : config_(config), volume_edge_m_(volume_edge_m) {}

  /// Samples the outline of a surface that has just been rendered.
  void sample(const PredictedSurface& surface);

  /// @param image the rendered surface that the samples were taken from.
  /// @param motions of the body's pieces since then.
  /// @return point-to-plane associations: only the distance across the outline in the image counts. The
  /// reference is valid until the next call.
  const std::vector<Association>& associate(const RgbdFrame& frame, const RasterImage& image,
                                            const RigidMotions& motions, const ColorModel& colors);

 private:
  void addEnds(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b);
  void addSample(const PredictedSurface& surface, const cv::Point& pixel, const cv::Point& across);

  OutlineConfig config_;
  double volume_edge_m_;
  int spacing_px_ = 1;
  std::vector<OutlineSample> samples_;
  std::vector<Association> found_;
};

}  // namespace softbody
