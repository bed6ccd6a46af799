#pragma once

#include <cstddef>
#include <vector>

#include "prediction/surface_samples.h"

namespace softbody {

struct DepthBlock;

/// What the blocks of one frame say of depth's noise.
struct NoiseSample {
  double density = 0.0;   ///< one sigma of a block's mean depth, times the block's width [m^2]
  std::size_t bends = 0;  ///< so many rows of three blocks say so
};

/// By how far blocks lie off the middle between two others, beside or above and below them: where the
/// prediction is off or tilted, all three are alike. A bend that it lacks counts by the square of their
/// distance.
/// @param memory for its memory.
NoiseSample noiseOf(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks, double focal_px,
                    std::vector<double>* memory);

/// The noise of depth, remembered over frames: a frame in which little of the body shows says little of it.
/// The mean over a patch errs by the density over the patch's side, however many blocks the patch has, if
/// each block errs by itself; of a stereo camera's, blocks of one or two pixels understate it, by up to a
/// half.
class DepthNoise {
 public:
  void learn(const NoiseSample& sample);

  /// @return one sigma of the mean depth over a patch of so long a side [m].
  double over(double side_m) const;

 private:
  double variance_ = 0.0;  ///< square of the density [m^4]
  double bends_ = 30.0;    ///< that it is known by; at first as if so many had said that there is none
};

}  // namespace softbody
