#pragma once

#include <vector>

#include "depth/depth_noise_estimator.h"
#include "prediction/association.h"
#include "prediction/color_model.h"
#include "prediction/surface_samples.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// What the depth image says of the predicted surface.
struct DepthAssociations {
  std::vector<Association> associations;
  int visible_blocks = 0;   ///< blocks of pixels that the prediction covers and the camera measured
  int occluded_blocks = 0;  ///< something nearer, or of another colour, stands there
  int absent_blocks = 0;    ///< the camera looks through: the body is not where it was predicted
  DepthNoiseSample noise;        ///< where every pixel of a block counts
};

/// What a block of pixels shows.
struct DepthBlock {
  enum class Kind { kUnmeasured, kAgrees, kOccluded, kAbsent };
  Kind kind = Kind::kUnmeasured;
  cv::Point center;          ///< where the sample is now [px]
  double predicted = 0.0;    ///< depth of the sample's plane there [m]
  double difference = 0.0;   ///< mean of the agreeing pixels: measured minus predicted [m]
  Eigen::Vector3d position;  ///< the sample's, moved [m]
  Eigen::Vector3d normal;
};

/// Associates visible surface with the depth measured along the same rays (projective association, point to
/// plane). A block of pixels gives one association, with the mean of its depth differences. What goes on from
/// an occluder without a step in depth, nearer than the body should be, belongs to the occluder.
class DepthAssociator {
 public:
  /// @param volume_edge_m mean edge of the tets: depth weights are per square of it.
  DepthAssociator(const DepthConfig& config, double volume_edge_m)
      : config_(config), volume_edge_m_(volume_edge_m) {}

  /// @param image the surface as rendered when it was sampled. @param motions of the body's pieces since
  /// then.
  /// @param pixel_step 1: every pixel of a block; 2: every second one of every second row, and so on.
  /// @return valid until the next call, which reuses its memory.
  const DepthAssociations& associate(const RgbdFrame& frame, const RasterImage& image,
                                     const SurfaceSamples& surface, const RigidMotions& motions,
                                     const ColorModel& colors, int pixel_step = 1);

 private:
  DepthConfig config_;
  double volume_edge_m_;
  std::vector<DepthBlock> blocks_;
  std::vector<double> second_differences_;
  DepthAssociations found_;
};

/// Where depth is noisier than usual, its targets weigh less by the square of that, within limits. The rigid
/// step keeps their full weight: its six numbers are means over all of the body.
/// @param relative_noise of the mean depth over a patch of one edge of the volume squared, per edge: in
/// proportion to the body it bends large and small ones alike.
void downweightByNoise(double relative_noise, DepthAssociations* depth);

}  // namespace softbody
