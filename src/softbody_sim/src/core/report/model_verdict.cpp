#include "report/model_verdict.h"

#include <fmt/format.h>

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
constexpr int kQuickTets = 5000, kSlowTets = 20000;
constexpr double kExactWeights = 1e-6, kRoughWeights = 1e-3;  // of the size

Verdict upTo(double value, double good, double bad) {
  return value <= good ? Verdict::kGood : value <= bad ? Verdict::kLookHere : Verdict::kBad;
}

Judgement judged(Verdict verdict, std::string fact, const char* advice) {
  if (verdict != Verdict::kGood) fact += fmt::format("; {}", advice);
  return {verdict, std::move(fact)};
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

}  // namespace

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

Verdict worst(const std::vector<Judgement>& judgements) {
  Verdict result = Verdict::kGood;
  for (const Judgement& judgement : judgements) result = std::max(result, judgement.verdict);
  return result;
}

const char* nameOf(Verdict verdict) {
  return verdict == Verdict::kGood ? "good" : verdict == Verdict::kLookHere ? "look here" : "bad";
}

}  // namespace softbody
