#pragma once

#include <vector>

#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// How one frame agrees with the surface that all frames gave.
struct FrameAgreement {
  Nanoseconds stamp = 0;
  int pixels = 0;  ///< that should show the object and have depth
  double through =
      0.0;  ///< share of these that look through it: what was measured lies farther by more than noise
};

/// Compares each frame's depth with the surface. What hides the object, such as a hand, is no disagreement.
/// @param inverse_depth_std see measureInverseDepthNoise().
std::vector<FrameAgreement> agreementWith(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                                          double inverse_depth_std);

/// Frames that look through the object far more than the others: their pose is wrong, or the object was
/// elsewhere.
/// @return for each frame, whether it is one.
std::vector<bool> disagreeing(const std::vector<FrameAgreement>& frames);

}  // namespace softbody::scanning
