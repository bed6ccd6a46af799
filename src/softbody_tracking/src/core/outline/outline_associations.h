#pragma once

#include <vector>

#include "outline/outline_line.h"
#include "prediction/association.h"
#include "prediction/predicted_surface.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The predicted outline compared with a frame.
struct OutlineAssociations {
  std::vector<Association> associations;  ///< only the distance across the outline in the image counts
  /// Area between predicted and measured outline, as a share of the body's area in the image. Only lines that
  /// contradict the prediction count: one that knows little says nothing against it. Where the outline is
  /// hidden, it is assumed to be as elsewhere.
  double disagreement = 0.0;
};

/// Associates the predicted outline with the body's outline in the frame, along the outline's normal in the
/// image: region-based tracking (Stoiber et al. 2022, SRT3D), with colour and depth as evidence. It corrects
/// errors perpendicular to the line of sight, which depth along the rays does not show.
class OutlineAssociator {
 public:
  /// @param volume_edge_m mean edge of the tets; config.weight is the weight per edge.
  OutlineAssociator(const OutlineConfig& config, double volume_edge_m)
      : config_(config), volume_edge_m_(volume_edge_m) {}

  /// Samples the outline of a surface that has just been rendered.
  void sample(const PredictedSurface& surface);

  /// @param image the rendered surface that the samples were taken from.
  /// @param motions of the body's pieces since then.
  /// @return a reference that is valid until the next call.
  const OutlineAssociations& associate(const RgbdFrame& frame, const RasterImage& image,
                                       const RigidMotions& motions, const RegionColors& colors);

 private:
  void addEnds(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b);
  void addSample(const PredictedSurface& surface, const cv::Point& pixel, const cv::Point& across);

  OutlineConfig config_;
  double volume_edge_m_;
  int spacing_px_ = 1;
  std::vector<ContourSample> samples_;
  int covered_px_ = 1;  ///< pixels that show the predicted body
  OutlineAssociations found_;
};

}  // namespace softbody
