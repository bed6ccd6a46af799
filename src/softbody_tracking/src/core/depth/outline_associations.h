#pragma once

#include <vector>

#include "prediction/association.h"
#include "prediction/color_model.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// A pixel at which the predicted surface ends in the image, before something farther or nothing at all.
struct OutlineSample {
  cv::Point pixel;
  Eigen::Vector2d outward;  ///< unit, in the image
  MaterialPoint place;
  std::uint32_t body = 0;    ///< the piece that it belongs to
  Eigen::Vector3d position;  ///< camera frame [m]
};

/// Where the frame shows that the body ends elsewhere than the predicted outline, along its normal in the
/// image (Harris and Stennett 1990, RAPID). Depth along rays says nothing of surface that lies beside the
/// body, or of body beside the surface:
/// - The camera sees through the prediction to what is clearly farther: the outline is pulled back.
/// - The body goes on beyond the prediction, with neither a step in depth nor another colour, up to a clear
///   step backwards: the outline is pulled out.
/// An error of up to two pixels says nothing, since depth at edges is no better. Nor does a sample where
/// something nearer, a foreign colour, much missing depth or the image's border comes in between.
class OutlineAssociator {
 public:
  /// @param volume_edge_m mean edge of the tets: weights are per edge.
  OutlineAssociator(const OutlineConfig& config, double volume_edge_m)
      : config_(config), volume_edge_m_(volume_edge_m) {}

  /// Samples the outline of a surface as just rendered.
  void sample(const PredictedSurface& surface);

  /// @param image the surface as rendered when it was sampled. @param motions of the body's pieces since
  /// then. @return only the distance across the outline, in the image, counts. Valid until the next call.
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
