#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"
#include "softbody_evaluation/measures/vertex_match.h"

namespace softbody::evaluation {

/// Properties of the truth's vertices that hold for all frames; empty: unknown.
struct VertexGroups {
  std::vector<bool> near_cut;
  std::vector<bool> seen_at_first;  ///< visible in the first frame of this topology
  std::vector<int> pieces;          ///< -1: a vertex without triangles
};

/// Distances to the truth of one frame [m].
struct FrameVertexError {
  Nanoseconds stamp = 0;
  std::vector<float> visible, hidden;                        ///< by the truth's confidence
  std::vector<float> visible_deviations, hidden_deviations;  ///< predicted for these; empty: not estimated
  std::vector<float> near_cut;                               ///< of all these: near a cut
  std::vector<float> covered;                                ///< of the hidden ones: visible at first
  std::vector<std::vector<float>> pieces;                    ///< by true piece
  std::size_t unmatched = 0;                                 ///< vertices without a match in the truth

  double mean() const;
};

/// @param matches from matchVertices. @param groups of the truth's vertices.
/// @throw std::invalid_argument if the states do not fit the matches.
FrameVertexError vertexError(const MeshState& result, const MeshState& truth, const std::vector<int>& matches,
                             const VertexGroups& groups = {});

/// Errors of a sequence [m].
struct VertexErrorReport {
  Summary all, visible, hidden, near_cut;
  std::vector<Summary> pieces;      ///< by true piece, of frames with several pieces
  double unmatched_share = 0.0;     ///< of the result's vertices, 0..1
  double first_time_s = 0.0;        ///< of the first of these frames, since the truth's first one
  std::vector<double> times;        ///< of the frames, since the first [s]
  std::vector<double> frame_means;  ///< [m]
  /// The same for parts of each frame [m]; NaN for a frame without such vertices.
  std::vector<double> frame_visible_means, frame_visible_largest, frame_hidden_means, frame_covered_means;
  double drift_m_per_s = 0.0;     ///< slope of frame_means over time
  double drift_window_s = 0.0;    ///< 5 s, or half of a shorter sequence
  double drift_m = 0.0;           ///< mean error in the last window minus that in the first
  double drift_ratio = kNothing;  ///< last / first
};

VertexErrorReport summarize(const std::vector<FrameVertexError>& frames);

}  // namespace softbody::evaluation
