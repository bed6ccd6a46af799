#pragma once

#include <vector>

#include "softbody_bringup/evaluation/statistics.h"
#include "softbody_common/types.h"

namespace softbody::evaluation {

/// Which truth vertex each result vertex stands for (the one with the same index in the input file); -1:
/// none, as for vertices made by a cut. @param parents MeshTopology::vertex_parents of both.
std::vector<int> matchVertices(const std::vector<int>& result_parents, const std::vector<int>& truth_parents);

/// Distances to the truth of one frame [m].
struct FrameVertexError {
  Nanoseconds stamp = 0;
  std::vector<float> visible, hidden;  ///< by the truth's confidence

  double mean() const;
};

/// @param matches of matchVertices. @throw std::invalid_argument if the states do not have the vertices
/// matched.
FrameVertexError vertexError(const MeshState& result, const MeshState& truth,
                             const std::vector<int>& matches);

/// Over a sequence [m].
struct VertexErrorReport {
  Summary all, visible, hidden;
  std::vector<double> times;        ///< of the frames, from the first [s]
  std::vector<double> frame_means;  ///< [m]
  double drift_m_per_s = 0.0;       ///< slope of frame_means over time
};

VertexErrorReport summarize(const std::vector<FrameVertexError>& frames);

}  // namespace softbody::evaluation
