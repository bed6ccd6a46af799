#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// Frames [first, last) of a sequence.
struct FrameRange {
  std::size_t first = 0, last = 0;
};

/// The longest ranges in which no vertex moves farther than `largest_m` from its position in the range's
/// first frame, with at least `least_frames` frames. A new topology ends a range.
std::vector<FrameRange> stillRanges(const std::vector<const MeshState*>& states, double largest_m,
                                    std::size_t least_frames);

/// Jitter of the result while the truth is still.
struct JitterReport {
  std::size_t frames = 0;  ///< still frames with an answer
  Summary per_vertex;      ///< RMS distance of a vertex from its mean position, over vertices and ranges [m]
};

/// @param states of the result, one per frame of the truth; null: no answer. @param still from stillRanges.
JitterReport jitter(const std::vector<const MeshState*>& states, const std::vector<FrameRange>& still);

}  // namespace softbody::evaluation
