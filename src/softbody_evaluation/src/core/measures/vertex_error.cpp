#include "softbody_evaluation/measures/vertex_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "softbody_common/time/time.h"

namespace softbody::evaluation {
namespace {

void append(const std::vector<float>& values, std::vector<float>* all) {
  all->insert(all->end(), values.begin(), values.end());
}

constexpr double kDriftWindow_s = 5.0;

/// Mean of the values at times within [first, last].
double meanWithin(const std::vector<double>& times, const std::vector<double>& values, double first,
                  double last) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < first || times[i] > last) continue;
    sum += values[i];
    ++count;
  }
  return sum / count;
}

void addDrift(VertexErrorReport* report) {
  if (report->times.empty()) return;
  const double end = report->times.back();
  report->drift_m_per_s = slope(report->times, report->frame_means);
  report->drift_window_s = std::min(kDriftWindow_s, 0.5 * end);
  const double first = meanWithin(report->times, report->frame_means, 0.0, report->drift_window_s),
               last = meanWithin(report->times, report->frame_means, end - report->drift_window_s, end);
  report->drift_m = last - first;
  if (first > 0.0) report->drift_ratio = last / first;
}

void addToPiece(float distance, std::size_t piece, std::vector<std::vector<float>>* pieces) {
  if (pieces->size() <= piece) pieces->resize(piece + 1);
  (*pieces)[piece].push_back(distance);
}

/// Errors by true piece, of frames with several pieces.
std::vector<Summary> summarizePieces(const std::vector<FrameVertexError>& frames) {
  std::vector<std::vector<float>> all;
  for (const FrameVertexError& frame : frames) {
    if (frame.pieces.size() < 2) continue;
    all.resize(std::max(all.size(), frame.pieces.size()));
    for (std::size_t i = 0; i < frame.pieces.size(); ++i) append(frame.pieces[i], &all[i]);
  }
  std::vector<Summary> summaries;
  summaries.reserve(all.size());
  for (std::vector<float>& piece : all) summaries.push_back(summarize(std::move(piece)));
  return summaries;
}

void requireVertices(const MeshState& result, const MeshState& truth, const std::vector<int>& matches) {
  if (static_cast<std::size_t>(result.vertices.rows()) != matches.size()) {
    throw std::invalid_argument(fmt::format("the result's state has {} vertices but its topology {}",
                                            result.vertices.rows(), matches.size()));
  }
  const auto largest = std::max_element(matches.begin(), matches.end());
  if (largest != matches.end() && *largest >= truth.vertices.rows()) {
    throw std::invalid_argument(fmt::format("the truth's state has {} vertices; vertex {} is asked for",
                                            truth.vertices.rows(), *largest));
  }
}

double sum(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double meanOf(const std::vector<float>& values) {
  return values.empty() ? kNothing : sum(values) / static_cast<double>(values.size());
}

void addFrame(const FrameVertexError& frame, VertexErrorReport* report) {
  const auto largest = std::max_element(frame.visible.begin(), frame.visible.end());
  report->frame_means.push_back(frame.mean());
  report->frame_visible_means.push_back(meanOf(frame.visible));
  report->frame_visible_largest.push_back(largest == frame.visible.end() ? kNothing : *largest);
  report->frame_hidden_means.push_back(meanOf(frame.hidden));
  report->frame_covered_means.push_back(meanOf(frame.covered));
}

}  // namespace

double FrameVertexError::mean() const {
  const std::size_t count = visible.size() + hidden.size();
  return count == 0 ? 0.0 : (sum(visible) + sum(hidden)) / static_cast<double>(count);
}

FrameVertexError vertexError(const MeshState& result, const MeshState& truth, const std::vector<int>& matches,
                             const VertexGroups& groups) {
  requireVertices(result, truth, matches);
  FrameVertexError error;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) {
      ++error.unmatched;
      continue;
    }
    const auto match = static_cast<std::size_t>(matches[i]);
    const auto distance = static_cast<float>(
        (result.vertices.row(static_cast<Eigen::Index>(i)) - truth.vertices.row(matches[i])).norm());
    const bool visible = truth.confidence.at(match) > 0.5f;
    (visible ? error.visible : error.hidden).push_back(distance);
    if (!result.standard_deviation.empty())
      (visible ? error.visible_deviations : error.hidden_deviations)
          .push_back(result.standard_deviation.at(i));
    if (!groups.near_cut.empty() && groups.near_cut[match]) error.near_cut.push_back(distance);
    if (!groups.seen_at_first.empty() && groups.seen_at_first[match] && !visible)
      error.covered.push_back(distance);
    if (!groups.pieces.empty() && groups.pieces[match] >= 0)
      addToPiece(distance, static_cast<std::size_t>(groups.pieces[match]), &error.pieces);
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
    report.times.push_back(seconds(frame.stamp - frames.front().stamp));
    addFrame(frame, &report);
  }
  addDrift(&report);
  report.pieces = summarizePieces(frames);
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
