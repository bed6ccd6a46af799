#include "softbody_bringup/evaluation/vertex_error.h"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace softbody::evaluation {
namespace {

void append(const std::vector<float>& values, std::vector<float>* all) {
  all->insert(all->end(), values.begin(), values.end());
}

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

std::vector<int> matchVertices(const std::vector<int>& result_parents,
                               const std::vector<int>& truth_parents) {
  std::unordered_map<int, int> truth_of_parent;
  for (std::size_t i = 0; i < truth_parents.size(); ++i)
    truth_of_parent.emplace(truth_parents[i], static_cast<int>(i));
  truth_of_parent.erase(-1);
  std::vector<int> matches;
  matches.reserve(result_parents.size());
  for (const int parent : result_parents) {
    const auto found = truth_of_parent.find(parent);
    matches.push_back(found == truth_of_parent.end() ? -1 : found->second);
  }
  return matches;
}

double FrameVertexError::mean() const {
  const std::size_t count = visible.size() + hidden.size();
  return count == 0 ? 0.0 : (sum(visible) + sum(hidden)) / static_cast<double>(count);
}

FrameVertexError vertexError(const MeshState& result, const MeshState& truth,
                             const std::vector<int>& matches) {
  if (static_cast<std::size_t>(result.vertices.rows()) != matches.size()) {
    throw std::invalid_argument(fmt::format("the result's state has {} vertices but its topology {}",
                                            result.vertices.rows(), matches.size()));
  }
  FrameVertexError error;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const int match = matches[i];
    if (match < 0) continue;
    if (match >= truth.vertices.rows()) {
      throw std::invalid_argument(fmt::format("the truth's state has {} vertices; vertex {} is asked for",
                                              truth.vertices.rows(), match));
    }
    const double distance =
        (result.vertices.row(static_cast<Eigen::Index>(i)) - truth.vertices.row(match)).norm();
    const bool visible = truth.confidence.at(static_cast<std::size_t>(match)) > 0.5f;
    (visible ? error.visible : error.hidden).push_back(static_cast<float>(distance));
  }
  return error;
}

VertexErrorReport summarize(const std::vector<FrameVertexError>& frames) {
  VertexErrorReport report;
  std::vector<float> visible, hidden;
  for (const FrameVertexError& frame : frames) {
    append(frame.visible, &visible);
    append(frame.hidden, &hidden);
    report.times.push_back(1e-9 * static_cast<double>(frame.stamp - frames.front().stamp));
    report.frame_means.push_back(frame.mean());
  }
  report.drift_m_per_s = slope(report.times, report.frame_means);
  report.visible = summarize(visible);
  report.hidden = summarize(hidden);
  append(hidden, &visible);
  report.all = summarize(std::move(visible));
  return report;
}

}  // namespace softbody::evaluation
