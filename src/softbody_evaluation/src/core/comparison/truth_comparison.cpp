#include "comparison/truth_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

#include "measures/material_match.h"
#include "report/plots.h"
#include "softbody_common/time/time.h"
#include "softbody_evaluation/measures/surface_distance.h"
#include "softbody_evaluation/measures/vertex_match.h"

namespace softbody::evaluation {
namespace {

constexpr double kStill_m = 1e-4;  // largest motion of a still truth
constexpr std::size_t kLeastStillFrames = 10;

/// Matches of a pair of topologies.
struct TopologyPair {
  VertexMatches matches;
  VertexGroups groups;
  PieceMatch pieces;
};

/// The vertices that the camera sees in the first frame of a revision.
std::vector<bool> seenAtFirst(const SurfaceRecord& truth, std::uint32_t revision) {
  const auto first = std::find_if(truth.states.begin(), truth.states.end(), [revision](const auto& state) {
    return state.second.revision == revision;
  });
  std::vector<bool> seen;
  for (const float confidence : first->second.confidence) seen.push_back(confidence > 0.5f);
  return seen;
}

class TopologyPairs {
 public:
  TopologyPairs(const EvaluatorOptions& options, const SurfaceRecord& result, const SurfaceRecord& truth)
      : options_(options), result_(result), truth_(truth) {}

  /// The pair of the states of a stamp.
  const TopologyPair& of(Nanoseconds stamp, const MeshState& answer, const MeshState& expected) {
    const MaterialMap& material = materialAt(result_, stamp);
    const auto [pair, fresh] = pairs_.try_emplace({&material, answer.revision, expected.revision});
    if (fresh) pair->second = make(material, topologyOf(result_, answer), topologyOf(truth_, expected));
    return pair->second;
  }

  FrameVertexError errorOf(Nanoseconds stamp, const MeshState& answer, const MeshState& expected) {
    const TopologyPair& pair = of(stamp, answer, expected);
    FrameVertexError error = vertexError(ontoVertices(answer, expected, pair.matches), expected,
                                         pair.matches.vertices, pair.groups);
    error.stamp = stamp;
    return error;
  }

 private:
  TopologyPair make(const MaterialMap& material, const MeshTopology& result,
                    const MeshTopology& truth) const {
    TopologyPair pair;
    pair.matches = matchMaterial(material, result, truth, options_.cut_vertex_m);
    pair.groups = {nearCut(truth, options_.near_cut_m), seenAtFirst(truth_, truth.revision),
                   vertexPieces(truth)};
    pair.pieces = matchPieces(result, truth, pair.matches.vertices);
    return pair;
  }

  const EvaluatorOptions& options_;
  const SurfaceRecord &result_, &truth_;
  std::map<std::tuple<const MaterialMap*, std::uint32_t, std::uint32_t>, TopologyPair> pairs_;
};

std::optional<JitterReport> jitterWhereStill(const SurfaceRecord& result, const SurfaceRecord& truth) {
  std::vector<const MeshState*> truths, answers;
  for (const auto& [stamp, state] : truth.states) {
    truths.push_back(&state);
    const auto answer = result.states.find(stamp);
    answers.push_back(answer == result.states.end() ? nullptr : &answer->second);
  }
  const std::vector<FrameRange> still = stillRanges(truths, kStill_m, kLeastStillFrames);
  if (still.empty()) return std::nullopt;
  return jitter(answers, still);
}

/// Sums over the frames after the first cut of either surface.
class PiecesSums {
 public:
  void add(double time_s, const PieceMatch& pieces) {
    if (report_.frames == 0 || pieces.true_pieces != report_.true_pieces) true_since_s_ = time_s;
    if (report_.frames == 0 || pieces.result_pieces != report_.result_pieces) result_since_s_ = time_s;
    ++report_.frames;
    report_.frames_right += pieces.result_pieces == pieces.true_pieces;
    report_.vertices_right += pieces.vertices_right;
    report_.result_pieces = pieces.result_pieces;
    report_.true_pieces = pieces.true_pieces;
  }

  std::optional<PiecesReport> report() const {
    if (report_.frames == 0) return std::nullopt;
    PiecesReport means = report_;
    means.frames_right /= static_cast<double>(means.frames);
    means.vertices_right /= static_cast<double>(means.frames);
    if (means.result_pieces == means.true_pieces) means.delay_s = result_since_s_ - true_since_s_;
    return means;
  }

 private:
  PiecesReport report_;
  double true_since_s_ = 0.0, result_since_s_ = 0.0;  ///< the numbers of pieces are the present ones
};

/// The occlusions of the truth's frames, without errors.
std::vector<FrameOcclusion> occlusionsOf(const SurfaceRecord& truth) {
  std::map<std::uint32_t, std::vector<bool>> seen_of;
  std::vector<FrameOcclusion> occlusions;
  for (const auto& [stamp, state] : truth.states) {
    const auto [entry, fresh] = seen_of.try_emplace(state.revision);
    if (fresh) entry->second = seenAtFirst(truth, state.revision);
    const std::vector<bool>& seen = entry->second;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) covered += seen[i] && state.confidence[i] <= 0.5f;
    const auto all = std::max<std::ptrdiff_t>(1, std::count(seen.begin(), seen.end(), true));
    occlusions.emplace_back();
    occlusions.back().time_s = seconds(stamp - truth.states.begin()->first);
    occlusions.back().covered_share = static_cast<double>(covered) / static_cast<double>(all);
  }
  return occlusions;
}

/// Adds the errors for the same motion without occluders, and a note about missing states.
/// @throw std::invalid_argument if no frame has a state.
void addUnhidden(const EvaluatorOptions& options, const SurfaceRecord& unhidden, const SurfaceRecord& truth,
                 std::vector<FrameOcclusion>* occlusions, std::vector<std::string>* notes) {
  TopologyPairs pairs(options, unhidden, truth);
  std::size_t missing = 0;
  auto occlusion = occlusions->begin();
  for (const auto& [stamp, expected] : truth.states) {
    FrameOcclusion& shown = *occlusion++;
    const auto answer = unhidden.states.find(stamp);
    if (answer == unhidden.states.end()) {
      ++missing;
      continue;
    }
    shown.unhidden_error = pairs.errorOf(stamp, answer->second, expected).mean();
  }
  if (missing == truth.states.size()) {
    throw std::invalid_argument(
        fmt::format("{}: the unhidden body has no state with the stamp of a frame of {}", options.unhidden,
                    options.truth));
  }
  if (missing > 0) {
    notes->push_back(fmt::format(
        "{} has no state for {} of {} frames; their normal error is that of the frames before the occlusion",
        options.unhidden, missing, truth.states.size()));
  }
}

/// Distances from the true surface in all answered frames; empty if the result has no triangles.
std::optional<SurfaceDistanceReport> surfaceDistances(const SurfaceRecord& result,
                                                      const SurfaceRecord& truth) {
  std::map<std::uint32_t, std::vector<SurfaceSample>> places;  // by revision of the result
  std::vector<FrameSurfaceDistance> distances;
  for (const auto& [stamp, expected] : truth.states) {
    const auto answer = result.states.find(stamp);
    if (answer == result.states.end()) continue;
    const MeshTopology &surface = topologyOf(result, answer->second), &its = topologyOf(truth, expected);
    if (surface.triangles.rows() == 0 || its.triangles.rows() == 0) return std::nullopt;
    const auto [entry, fresh] = places.try_emplace(surface.revision);
    if (fresh) entry->second = measuredPlaces(surface);
    distances.push_back(surfaceDistance(entry->second, surface.triangles, answer->second, its, expected));
  }
  return summarize(distances);
}

/// Errors of the volume, if both surfaces are closed.
std::optional<Change> volumeError(const SurfaceRecord& result, const SurfaceRecord& truth) {
  std::vector<const MeshState*> answers, truths;
  for (const auto& [stamp, state] : truth.states) {
    const auto answer = result.states.find(stamp);
    if (answer == result.states.end()) continue;
    answers.push_back(&answer->second);
    truths.push_back(&state);
  }
  const std::vector<double> mine = volumeDrift(result.topologies, answers).volumes,
                            its = volumeDrift(truth.topologies, truths).volumes;
  if (mine.empty() || its.empty()) return std::nullopt;
  std::vector<double> errors;
  for (std::size_t i = 0; i < mine.size(); ++i) errors.push_back(mine[i] / its[i] - 1.0);
  return changeOf(errors);
}

/// Errors of the cut surface at the end, if the truth is cut.
std::optional<CutSurfaceReport> cutSurface(const SurfaceRecord& result, const SurfaceRecord& truth) {
  const MeshTopology& expected = topologyOf(truth, truth.states.rbegin()->second);
  if (std::find(expected.cut.begin(), expected.cut.end(), true) == expected.cut.end()) return std::nullopt;
  const auto& [stamp, last] = *result.states.rbegin();
  return compareCutSurfaces(inTruthMaterial(materialAt(result, stamp), topologyOf(result, last)), expected);
}

void plotVertexErrors(const VertexErrorReport& report, const std::vector<FrameVertexError>& frames,
                      Pictures* pictures) {
  std::vector<double> means = report.frame_means;
  for (double& mean : means) mean *= 1e3;
  (*pictures)["vertex_error.png"] = linePlot("mean vertex error [mm]", "time [s]", report.times, means);
  std::vector<float> all;
  for (const FrameVertexError& frame : frames) {
    all.insert(all.end(), frame.visible.begin(), frame.visible.end());
    all.insert(all.end(), frame.hidden.begin(), frame.hidden.end());
  }
  (*pictures)["vertex_error_histogram.png"] = histogram("vertex error", "[mm]", all, 1e3);
}

void plotCalibration(const CalibrationReport& report, Pictures* pictures) {
  std::vector<double> predicted, measured;
  for (const CalibrationBin& bin : report.bins) {
    predicted.push_back(1e3 * bin.predicted_rms);
    measured.push_back(1e3 * bin.error_rms);
  }
  (*pictures)["calibration.png"] = calibrationPlot("RMS error [mm] over predicted standard deviation [mm]",
                                                   "predicted [mm]", predicted, measured);
}

}  // namespace

OpenLoopReport compareOpenLoop(const EvaluatorOptions& options, const SurfaceRecord& result,
                               const SurfaceRecord& truth) {
  TopologyPairs pairs(options, result, truth);
  std::vector<FrameVertexError> errors;
  for (const auto& [stamp, expected] : truth.states) {
    const auto answer = result.states.find(stamp);
    if (answer != result.states.end()) errors.push_back(pairs.errorOf(stamp, answer->second, expected));
  }
  if (errors.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no predicted state has the stamp of a frame of {}", options.result, options.truth));
  }
  const MeshState& last = result.states.rbegin()->second;
  return {errors.size(), seconds(result.states.rbegin()->first - last.observed), summarize(errors).all,
          errors.back().mean()};
}

void compareWithTruth(const EvaluatorOptions& options, const SurfaceRecord& result,
                      const SurfaceRecord& truth, const SurfaceRecord* unhidden, Report* report,
                      Pictures* pictures) {
  TopologyPairs pairs(options, result, truth);
  std::vector<FrameVertexError> errors;
  std::vector<FrameOcclusion> occlusions = occlusionsOf(truth);
  PiecesSums pieces;
  auto occlusion = occlusions.begin();
  for (const auto& [stamp, expected] : truth.states) {
    FrameOcclusion& shown = *occlusion++;
    const auto answer = result.states.find(stamp);
    if (answer == result.states.end()) continue;
    errors.push_back(pairs.errorOf(stamp, answer->second, expected));
    shown.mean_error = errors.back().mean();
    shown.covered_errors = errors.back().covered;
    if (answer->second.revision > 0 || expected.revision > 0)
      pieces.add(seconds(stamp - truth.states.begin()->first),
                 pairs.of(stamp, answer->second, expected).pieces);
  }
  report->frames.expected = truth.states.size();
  report->frames.answered = errors.size();
  if (errors.empty()) return;
  report->vertex_error = summarize(errors);
  report->vertex_error->first_time_s = seconds(errors.front().stamp - truth.states.begin()->first);
  report->surface_distance = surfaceDistances(result, truth);
  report->calibration = calibration(errors);
  for (const FrameVertexError& error : errors) {
    const auto state = report->state_of.find(error.stamp);
    report->frame_states.push_back(state == report->state_of.end() ? "" : state->second);
  }
  if (unhidden != nullptr) addUnhidden(options, *unhidden, truth, &occlusions, &report->notes);
  report->absences = absences(occlusions);
  report->jitter = jitterWhereStill(result, truth);
  report->pieces = pieces.report();
  report->cut_surface = cutSurface(result, truth);
  report->volume.error = volumeError(result, truth);
  plotVertexErrors(*report->vertex_error, errors, pictures);
  if (report->calibration) plotCalibration(*report->calibration, pictures);
}

}  // namespace softbody::evaluation
