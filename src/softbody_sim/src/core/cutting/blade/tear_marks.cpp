#include "cutting/blade/tear_marks.h"

#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr double kSure = 5.0;        // standard deviations
constexpr std::size_t kMost = 2000;  // marks; more would only cost time

bool holdsMaterial(const Target& target, const TetTopology& volume) {
  return target.kind != TargetKind::kDepth && target.kind != TargetKind::kPrior && target.weight > 0.0 &&
         target.place.tet < volume.tets.rows();
}

/// Standard deviation of a target of weight 1, as measured: from the median misfit [m].
double unitDeviation(const TetTopology& volume, const Points& vertices, const std::vector<Target>& targets) {
  std::vector<double> misfits;
  for (const Target& target : targets) {
    if (!holdsMaterial(target, volume)) continue;
    const Eigen::Vector3d offset = target.position - positionOf(target.place, vertices, volume.tets);
    const double misfit =
        target.normal.isZero() ? offset.norm() / std::sqrt(3.0) : std::abs(target.normal.dot(offset));
    misfits.push_back(std::sqrt(target.weight) * misfit);
  }
  return median(&misfits) / kMedianPerSigma;
}

/// A feature has a target in each direction that it measures.
std::vector<TearMark> marksIn(const std::vector<bool>& tets, const TetTopology& volume,
                              const Points& vertices, const std::vector<Target>& targets) {
  const double unit = unitDeviation(volume, vertices, targets);
  std::vector<TearMark> marks;
  for (const Target& target : targets) {
    if (!holdsMaterial(target, volume) || !tets[static_cast<std::size_t>(target.place.tet)]) continue;
    if (!marks.empty() && marks.back().measured == target.position) continue;
    marks.push_back({positionOf(target.place, volume.rest_vertices, volume.tets), target.position,
                     unit / std::sqrt(target.weight)});
    if (marks.size() == kMost) break;
  }
  return marks;
}

/// Each pair that the tear separates votes for both sides, with the distance between them.
void tellSides(const Eigen::Vector3d& normal, double limit, double reach_m, std::vector<TearMark>* marks) {
  std::vector<double> votes(marks->size(), 0.0);
  for (std::size_t i = 0; i < marks->size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const TearMark &a = (*marks)[i], &b = (*marks)[j];
      const Eigen::Vector3d apart = a.rest - b.rest;
      const double length = apart.norm();
      if (length > reach_m) continue;
      const double excess = (a.measured - b.measured).norm() - (1.0 + limit) * length;
      if (excess <= kSure * std::hypot(a.deviation, b.deviation)) continue;
      votes[i] += apart.dot(normal);
      votes[j] -= apart.dot(normal);
    }
  }
  for (std::size_t i = 0; i < marks->size(); ++i)
    (*marks)[i].side = votes[i] > 0.0 ? 1.0 : votes[i] < 0.0 ? -1.0 : 0.0;
}

}  // namespace

std::vector<TearMark> tearMarks(const TetTopology& volume, const Points& vertices,
                                const std::vector<Target>& targets, double limit, const TearZone& zone) {
  std::vector<TearMark> marks = marksIn(tetsAround(volume, zone.tets), volume, vertices, targets);
  tellSides(zone.plane.normal, limit, 2.0 * zone.place_m, &marks);
  return marks;
}

}  // namespace softbody
