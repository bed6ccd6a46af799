#include "softbody_evaluation/measures/steadiness.h"

#include <Eigen/Dense>
#include <cmath>

namespace softbody::evaluation {
namespace {

bool sameTopology(const MeshState& a, const MeshState& b) {
  return a.revision == b.revision && a.vertices.rows() == b.vertices.rows();
}

double largestMove(const MeshState& a, const MeshState& b) {
  return a.vertices.rows() == 0 ? 0.0 : (a.vertices - b.vertices).rowwise().norm().maxCoeff();
}

/// RMS distance of every vertex from its mean position.
Eigen::VectorXd deviations(const std::vector<const MeshState*>& states) {
  Points mean = Points::Zero(states.front()->vertices.rows(), 3);
  for (const MeshState* state : states) mean += state->vertices / static_cast<double>(states.size());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(mean.rows());
  for (const MeshState* state : states) squares += (state->vertices - mean).rowwise().squaredNorm();
  return (squares / static_cast<double>(states.size())).cwiseSqrt();
}

/// The answers in a range, separated by the result's topologies.
std::vector<std::vector<const MeshState*>> answeredRuns(const std::vector<const MeshState*>& states,
                                                        const FrameRange& range) {
  std::vector<std::vector<const MeshState*>> runs;
  for (std::size_t i = range.first; i < range.last; ++i) {
    if (states[i] == nullptr) continue;
    if (runs.empty() || !sameTopology(*runs.back().front(), *states[i])) runs.emplace_back();
    runs.back().push_back(states[i]);
  }
  return runs;
}

}  // namespace

std::vector<FrameRange> stillRanges(const std::vector<const MeshState*>& states, double largest_m,
                                    std::size_t least_frames) {
  std::vector<FrameRange> ranges;
  for (std::size_t first = 0, last = 0; first < states.size(); first = last) {
    last = first + 1;
    while (last < states.size() && sameTopology(*states[first], *states[last]) &&
           largestMove(*states[first], *states[last]) <= largest_m)
      ++last;
    if (last - first >= least_frames) ranges.push_back({first, last});
  }
  return ranges;
}

JitterReport jitter(const std::vector<const MeshState*>& states, const std::vector<FrameRange>& still) {
  JitterReport report;
  std::vector<float> values;
  for (const FrameRange& range : still) {
    for (const auto& answered : answeredRuns(states, range)) {
      if (answered.size() < 2) continue;
      report.frames += answered.size();
      for (const double value : deviations(answered)) values.push_back(static_cast<float>(value));
    }
  }
  report.per_vertex = summarize(std::move(values));
  return report;
}

}  // namespace softbody::evaluation
