#include <map>
#include <stdexcept>
#include <utility>

#include "evaluation_comparisons.h"
#include "softbody_bringup/evaluation/plots.h"
#include "softbody_bringup/evaluation/vertex_match.h"

namespace softbody::evaluation {
namespace {

constexpr double kStill_m = 1e-4;  // how far the truth moves while it counts as still
constexpr std::size_t kLeastStillFrames = 10;

/// What is fixed while neither topology changes.
struct TopologyPair {
  std::vector<int> matches;
  std::vector<bool> near_cut;
  PieceMatch pieces;
};

class TopologyPairs {
 public:
  TopologyPairs(const EvaluatorOptions& options, const SurfaceRecord& result, const SurfaceRecord& truth)
      : options_(options), result_(result), truth_(truth) {}

  const TopologyPair& of(std::uint32_t result_revision, std::uint32_t truth_revision) {
    const auto [pair, fresh] = pairs_.try_emplace({result_revision, truth_revision});
    if (fresh)
      pair->second = make(result_.topologies.at(result_revision), truth_.topologies.at(truth_revision));
    return pair->second;
  }

 private:
  TopologyPair make(const MeshTopology& result, const MeshTopology& truth) const {
    TopologyPair pair;
    pair.matches = matchVertices(result, truth, options_.cut_vertex_m);
    pair.near_cut = nearCut(truth, options_.near_cut_m);
    pair.pieces = matchPieces(result, truth, pair.matches);
    return pair;
  }

  const EvaluatorOptions& options_;
  const SurfaceRecord &result_, &truth_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, TopologyPair> pairs_;
};

/// Sums over the frames after the truth's first cut.
void addPieces(const PieceMatch& pieces, PiecesReport* report) {
  ++report->frames;
  report->frames_right += pieces.result_pieces == pieces.true_pieces;
  report->vertices_right += pieces.vertices_right;
  report->result_pieces = pieces.result_pieces;
  report->true_pieces = pieces.true_pieces;
}

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

std::vector<float> inMillimetres(std::vector<float> metres) {
  for (float& value : metres) value *= 1e3f;
  return metres;
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
  (*pictures)["vertex_error_histogram.png"] =
      histogram("vertex error", "[mm]", inMillimetres(std::move(all)));
}

}  // namespace

void compareWithTruth(const EvaluatorOptions& options, const SurfaceRecord& result,
                      const SurfaceRecord& truth, Report* report, Pictures* pictures) {
  TopologyPairs pairs(options, result, truth);
  std::vector<FrameVertexError> errors;
  PiecesReport pieces;
  for (const auto& [stamp, expected] : truth.states) {
    const auto answer = result.states.find(stamp);
    if (answer == result.states.end()) continue;
    const TopologyPair& pair = pairs.of(answer->second.revision, expected.revision);
    errors.push_back(vertexError(answer->second, expected, pair.matches, pair.near_cut));
    errors.back().stamp = stamp;
    if (expected.revision > 0) addPieces(pair.pieces, &pieces);
  }
  report->frames = {truth.states.size(), errors.size()};
  report->vertex_error = summarize(errors);
  if (!errors.empty() && report->vertex_error->all.count == 0) {
    throw std::runtime_error(
        "no vertex of the result has a counterpart in the truth (vertex_parents): another mesh?");
  }
  report->jitter = jitterWhereStill(result, truth);
  if (pieces.frames > 0) {
    pieces.frames_right /= static_cast<double>(pieces.frames);
    pieces.vertices_right /= static_cast<double>(pieces.frames);
    report->pieces = pieces;
  }
  plotVertexErrors(*report->vertex_error, errors, pictures);
}

}  // namespace softbody::evaluation
