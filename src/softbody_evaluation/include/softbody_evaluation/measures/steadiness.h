#pragma once

#include <vector>

#include "softbody_common/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// Frames [first, last) of a sequence.
struct FrameRange {
  std::size_t first = 0, last = 0;
};

/// The longest stretches, from the start on, in which no vertex goes farther than `largest_m` from where it
/// was in the stretch's first frame; those of at least `least_frames` frames. A new topology ends a stretch.
std::vector<FrameRange> stillRanges(const std::vector<const MeshState*>& states, double largest_m,
                                    std::size_t least_frames);

/// How much the result trembles where the truth is still.
struct JitterReport {
  std::size_t frames = 0;  ///< still ones with an answer
  Summary per_vertex;      ///< RMS distance of a vertex from its mean place, over vertices and stretches [m]
};

/// @param states of the result, one a frame of the truth; null: no answer. @param still of stillRanges.
JitterReport jitter(const std::vector<const MeshState*>& states, const std::vector<FrameRange>& still);

}  // namespace softbody::evaluation
