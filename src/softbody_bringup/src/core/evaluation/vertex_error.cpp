#include "softbody_bringup/evaluation/vertex_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace softbody::evaluation {
namespace {

void append(const std::vector<float>& values, std::vector<float>* all) {
  all->insert(all->end(), values.begin(), values.end());
}

constexpr double kDriftWindow_s = 5.0;

/// Mean of the values at times within [first, last]; 0 if there are none.
double meanWithin(const std::vector<double>& times, const std::vector<double>& values, double first,
                  double last) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < first || times[i] > last) continue;
    sum += values[i];
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

void addDrift(VertexErrorReport* report) {
  if (report->times.empty()) return;
  const double end = report->times.back();
  report->drift_m_per_s = slope(report->times, report->frame_means);
  report->drift_window_s = std::min(kDriftWindow_s, 0.5 * end);
  report->drift_m = meanWithin(report->times, report->frame_means, end - report->drift_window_s, end) -
                    meanWithin(report->times, report->frame_means, 0.0, report->drift_window_s);
}

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

double FrameVertexError::mean() const {
  const std::size_t count = visible.size() + hidden.size();
  return count == 0 ? 0.0 : (sum(visible) + sum(hidden)) / static_cast<double>(count);
}

FrameVertexError vertexError(const MeshState& result, const MeshState& truth, const std::vector<int>& matches,
                             const std::vector<bool>& near_cut) {
  if (static_cast<std::size_t>(result.vertices.rows()) != matches.size()) {
    throw std::invalid_argument(fmt::format("the result's state has {} vertices but its topology {}",
                                            result.vertices.rows(), matches.size()));
  }
  FrameVertexError error;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const int match = matches[i];
    if (match < 0) {
      ++error.unmatched;
      continue;
    }
    if (match >= truth.vertices.rows()) {
      throw std::invalid_argument(fmt::format("the truth's state has {} vertices; vertex {} is asked for",
                                              truth.vertices.rows(), match));
    }
    const double distance =
        (result.vertices.row(static_cast<Eigen::Index>(i)) - truth.vertices.row(match)).norm();
    const bool visible = truth.confidence.at(static_cast<std::size_t>(match)) > 0.5f;
    (visible ? error.visible : error.hidden).push_back(static_cast<float>(distance));
    if (!near_cut.empty() && near_cut.at(static_cast<std::size_t>(match)))
      error.near_cut.push_back(static_cast<float>(distance));
  }
  return error;
}

VertexErrorReport summarize(const std::vector<FrameVertexError>& frames) {
  VertexErrorReport report;
  std::vector<float> visible, hidden, near_cut;
  std::size_t unmatched = 0;
  for (const FrameVertexError& frame : frames) {
    append(frame.visible, &visible);
    append(frame.hidden, &hidden);
    append(frame.near_cut, &near_cut);
    unmatched += frame.unmatched;
    report.times.push_back(1e-9 * static_cast<double>(frame.stamp - frames.front().stamp));
    report.frame_means.push_back(frame.mean());
  }
  addDrift(&report);
  report.near_cut = summarize(std::move(near_cut));
  report.visible = summarize(visible);
  report.hidden = summarize(hidden);
  append(hidden, &visible);
  report.all = summarize(std::move(visible));
  const std::size_t vertices = report.all.count + unmatched;
  if (vertices > 0) report.unmatched_share = static_cast<double>(unmatched) / static_cast<double>(vertices);
  return report;
}

}  // namespace softbody::evaluation
