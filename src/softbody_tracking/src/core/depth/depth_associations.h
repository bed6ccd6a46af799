#pragma once

#include <vector>

#include "depth/depth_noise_estimator.h"
#include "labels/labels.h"
#include "prediction/association.h"
#include "prediction/surface_samples.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// The predicted surface compared with the depth image.
struct DepthAssociations {
  std::vector<Association> associations;
  int visible_blocks = 0;   ///< blocks of pixels with a prediction and a measurement
  int occluded_blocks = 0;  ///< blocks that show an occluder
  int absent_blocks = 0;    ///< blocks that show the background: the body is not there
  DepthNoiseSample noise;   ///< empty if pixels were skipped (pixel_step above 1)
};

/// A block of pixels around a surface sample.
struct DepthBlock {
  enum class Kind { kUnmeasured, kAgrees, kOccluded, kAbsent };
  Kind kind = Kind::kUnmeasured;
  cv::Point center;          ///< projection of the moved sample [px]
  double predicted = 0.0;    ///< depth of the moved sample's plane at the center [m]
  double difference = 0.0;   ///< mean of measured minus predicted depth over the agreeing pixels [m]
  double variance = 0.0;     ///< of these differences [m^2]
  Eigen::Vector3d position;  ///< of the moved sample, camera frame [m]
  Eigen::Vector3d normal;
};

/// How much depth counts.
struct DepthWeight {
  double per_area;  ///< of an area of one mean edge of the tets squared
  double edge_m;    ///< mean edge of the tets
};

/// Associates visible surface with depth along the same rays (projective data association, point to plane).
/// Each block of pixels gives one association, with the mean of its depth differences, weighed by the inverse
/// of their variance: at an edge, or where another side of the body is seen than predicted, the differences
/// of one block vary.
/// @param image the rendered surface that the samples were taken from.
/// @param motions of the body's pieces since then.
/// @param pixel_step 1: every pixel of a block counts; 2: every second pixel of every second row; and so on.
DepthAssociations associateDepth(const RgbdFrame& frame, const RasterImage& image,
                                 const SurfaceSamples& surface, const RigidMotions& motions,
                                 const Labels& labels, const DepthWeight& weight, int pixel_step = 1);

/// Reduces the weights of depth targets if the noise is above usual, by the square of the ratio, down to a
/// limit. Rigid alignment does not need this: its six parameters average over the whole body.
/// @param relative_noise standard deviation of the mean depth over a patch of one mean tet edge squared,
/// divided by that edge. The same value bends large and small bodies equally, relative to their size.
void downweightByNoise(double relative_noise, DepthAssociations* depth);

}  // namespace softbody
