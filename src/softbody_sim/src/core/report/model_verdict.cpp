#include "report/model_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace softbody {
namespace {

// Of each property: good up to the first limit, bad beyond the second.
constexpr double kSmallestSide_m = 0.02, kTiniestSide_m = 0.005, kLargestSide_m = 2.0, kHugeSide_m = 10.0;
constexpr double kFewOutside = 0.0, kManyOutside = 0.05;        // of the visual vertices
constexpr double kSnugVolume = 1.6, kLooseVolume = 3.0;         // cage over visual mesh
constexpr double kEvenEdges = 3.0, kUnevenEdges = 6.0;          // 95th over 5th percentile
constexpr double kWideAngle_deg = 8.0, kNarrowAngle_deg = 3.0;  // 1st percentile of the tets' smallest angles
constexpr int kQuickTets = 5000, kSlowTets = 20000;             // 10,000 take 18 ms a frame (make bench)
constexpr double kExactWeights = 1e-6, kRoughWeights = 1e-3;    // of the size
constexpr double kFrame_ms = 1000.0 / 30.0;                     // of a usual camera
constexpr double kCutVolumeError = 1e-3;    // a cut moves the surface by up to 1/20,000 of its size
constexpr double kCalmEnergy = 1.0 + 1e-3;  // over the start; free motion only loses energy

Verdict upTo(double value, double good, double bad) {
  return value <= good ? Verdict::kGood : value <= bad ? Verdict::kLookHere : Verdict::kBad;
}

Judgement judged(Verdict verdict, std::string fact, const char* advice) {
  if (verdict != Verdict::kGood) fact += fmt::format("; {}", advice);
  return {verdict, std::move(fact)};
}

std::string placeOfCrossing(const ModelTrial& trial) {
  if (trial.crossings == 0) return "";
  const Eigen::Vector3d place = 1e3 * trial.crossing;
  return fmt::format(", for example at ({:.1f}, {:.1f}, {:.1f}) mm", place[0], place[1], place[2]);
}

Judgement judgeSize(double side) {
  const Verdict small = upTo(-side, -kSmallestSide_m, -kTiniestSide_m),
                large = upTo(side, kLargestSide_m, kHugeSide_m);
  return judged(std::max(small, large), fmt::format("the longest side is {:.4g} mm", 1e3 * side),
                "compare it with a ruler; is the unit right? Set --unit, or --length 200mm");
}

Judgement judgeOutside(const ModelQuality& q) {
  const double share = q.outside / std::max(1.0, static_cast<double>(q.visual_vertices));
  return judged(upTo(share, kFewOutside, kManyOutside),
                fmt::format("{} of {} visual vertices are outside of the tets", q.outside, q.visual_vertices),
                "they follow the nearest tet; make a new cage with more --cage-vertices");
}

Judgement judgeVolume(const ModelQuality& q) {
  if (q.visual_volume <= 0.0)
    return {Verdict::kLookHere,
            "the visual mesh is open, so its volume is unknown; close it if the body is solid"};
  const double ratio = q.cage_volume / q.visual_volume;
  return judged(upTo(ratio, kSnugVolume, kLooseVolume),
                fmt::format("the cage has {:.2f} times the volume of the visual mesh", ratio),
                "thin or hollow parts are filled and become too stiff; give more --cage-vertices");
}

Judgement judgeTets(const ModelQuality& q) {
  return judged(upTo(-q.dihedral_percentile, -kWideAngle_deg, -kNarrowAngle_deg),
                fmt::format("1 tet in 100 has an angle below {:.1f} degrees", q.dihedral_percentile),
                "flat tets are too stiff; give another number of --cage-vertices");
}

Judgement judgeCuts(const ModelTrial& trial) {
  if (!trial.refused_cuts.empty())
    return {Verdict::kBad, fmt::format("cannot be cut {}; repair the mesh there{}",
                                       fmt::join(trial.refused_cuts, "; "), placeOfCrossing(trial))};
  if (trial.volume_error > kCutVolumeError)
    return {Verdict::kBad, fmt::format("the pieces of a cut differ from the whole by {:.2g} % of its volume; "
                                       "repair the mesh",
                                       100.0 * trial.volume_error)};
  if (trial.crossings > 0)
    return {Verdict::kLookHere,
            fmt::format("it can be cut, but not where {} pairs of triangles cross{}; repair "
                        "the mesh there",
                        trial.crossings, placeOfCrossing(trial))};
  return {Verdict::kGood, "cut by three planes, the pieces have the volume of the whole"};
}

Judgement judgeMotion(const ModelTrial& trial) {
  const bool calm = trial.inverted == 0 && trial.energy_growth <= kCalmEnergy;
  if (!calm)
    return {Verdict::kBad,
            fmt::format("stretched and let go, {} tets end inverted and the energy grows to {:.2g} "
                        "times; give another number of --cage-vertices",
                        trial.inverted, trial.energy_growth)};
  return {Verdict::kGood,
          fmt::format("stretched and let go, no tet inverts and the energy does not grow in {:.1f} s",
                      trial.simulated_s)};
}

/// The number of triangles with which the surface takes half of the frame's time.
int affordableTriangles(const FrameCost& cost, int triangles) {
  const double share = 0.5 * kFrame_ms / (cost.surface_ms + cost.drawing_ms);
  return std::max(1000, static_cast<int>(share * triangles) / 1000 * 1000);
}

Judgement judgeCost(const FrameCost& cost, int triangles) {
  std::string fact = fmt::format(
      "a frame takes {:.1f} ms on this machine: simulation {:.1f}, surface {:.1f}, drawing {:.1f}",
      cost.total(), cost.simulation_ms, cost.surface_ms, cost.drawing_ms);
  if (cost.total() <= kFrame_ms) return {Verdict::kGood, fact};
  const bool by_surface = cost.surface_ms + cost.drawing_ms > cost.simulation_ms;
  return {Verdict::kLookHere,
          fmt::format("{}; a camera at 30 Hz gives a frame every {:.0f} ms; give {}", fact, kFrame_ms,
                      by_surface ? fmt::format("--simplify {}", affordableTriangles(cost, triangles))
                                 : "fewer --cage-vertices")};
}

}  // namespace

std::vector<Judgement> judge(const ModelTrial& trial, int triangles) {
  if (!trial.failure.empty()) return {{Verdict::kBad, "cannot be used: " + trial.failure}};
  return {judgeCuts(trial), judgeMotion(trial), judgeCost(trial.cost, triangles)};
}

std::vector<Judgement> judge(const ModelQuality& q, double longest_side) {
  const double error = std::max(q.partition_error, q.reproduction_error / q.size);
  return {judgeSize(longest_side),
          judgeOutside(q),
          judgeVolume(q),
          judgeTets(q),
          judged(upTo(q.edge_spread, kEvenEdges, kUnevenEdges),
                 fmt::format("the cage's long edges are {:.1f} times its short ones", q.edge_spread),
                 "it bends unevenly; give another number of --cage-vertices"),
          judged(upTo(q.tets, kQuickTets, kSlowTets), fmt::format("{} tets", q.tets),
                 "the simulation may be slower than the camera; give fewer --cage-vertices"),
          judged(upTo(error, kExactWeights, kRoughWeights),
                 fmt::format("the cage's weights reproduce the visual mesh within {:.1e} of its size", error),
                 "the surface will not lie where the tets are; repair the mesh")};
}

std::vector<Judgement> judgementsOf(const ObjectModel& model, const ModelQuality& quality) {
  const Points& rest = model.visual.rest_vertices;
  std::vector<Judgement> all =
      judge(quality, (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff());
  for (Judgement& judgement : judge(tryModel(model), quality.visual_triangles)) all.push_back(judgement);
  for (const std::string& warning : model.warnings) all.push_back({Verdict::kLookHere, warning});
  return all;
}

Verdict worst(const std::vector<Judgement>& judgements) {
  Verdict result = Verdict::kGood;
  for (const Judgement& judgement : judgements) result = std::max(result, judgement.verdict);
  return result;
}

const char* nameOf(Verdict verdict) {
  return verdict == Verdict::kGood ? "good" : verdict == Verdict::kLookHere ? "look here" : "bad";
}

}  // namespace softbody
