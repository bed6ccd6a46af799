#pragma once

#include <cstddef>
#include <vector>

#include "prediction/surface_samples.h"

namespace softbody {

struct DepthBlock;

/// A measurement of depth noise from one frame.
struct DepthNoiseSample {
  double density = 0.0;   ///< standard deviation of a block's mean depth times the block's width [m^2]
  std::size_t count = 0;  ///< number of second differences that it was estimated from
};

/// Measures the noise by the second differences of depth over three blocks in a row or column. An offset or a
/// tilt of the prediction does not change them. A bend that the prediction lacks adds an error that grows
/// with the square of the distance between the blocks.
DepthNoiseSample sampleDepthNoise(const SurfaceSamples& surface, const std::vector<DepthBlock>& blocks,
                                  double focal_px);

/// Estimates the noise of depth over many frames, because a frame that shows little of the body measures it
/// badly. If the errors of the blocks are independent, the mean depth over a patch has a standard deviation
/// of density / (side of the patch), for any number of blocks. The errors of neighbouring pixels of a stereo
/// camera are not independent. So with blocks of one or two pixels the estimate is too small, by up to a
/// half.
class DepthNoiseEstimator {
 public:
  /// @param elapsed_s since the sample before.
  void update(const DepthNoiseSample& sample, double elapsed_s);

  /// Standard deviation of the mean depth over a square patch [m].
  double patchStdDev(double side_m) const;

 private:
  /// Fewest second differences behind an estimate: it starts as if these had measured no noise.
  static constexpr double kFewest = 30.0;

  double variance_ = 0.0;   ///< square of the density [m^4]
  double count_ = kFewest;  ///< second differences in it, fewer the older they are
};

}  // namespace softbody
