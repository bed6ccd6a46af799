#include "cutting/blade/tearing.h"

#include <algorithm>

#include "cutting/blade/tear_plane.h"
#include "cutting/blade/tear_reach.h"
#include "cutting/blade/tear_sides.h"
#include "cutting/patch/plane_section.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

// A tear that has begun runs on where the strain is above this share of the limit: at its tip the stress is
// larger.
constexpr double kRuns = 0.5;
constexpr double kFurther = 1.1;   // factor over the stretch of a patch that was not cut
constexpr double kOverhang = 0.1;  // over the mean edge length

/// As planeSection() does, a vertex on the plane counts as above it.
bool crosses(const TetTopology& volume, const RestPlane& plane, int tet) {
  int above = 0;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d corner = volume.rest_vertices.row(volume.tets(tet, k));
    above += plane.normal.dot(corner - plane.point) >= 0.0 ? 1 : 0;
  }
  return above > 0 && above < 4;
}

/// The most surely stretched tet of the zone on the plane; -1: none.
int startOf(const TetTopology& volume, const std::vector<TetStretch>& stretches, const TearZone& zone,
            const RestPlane& plane) {
  int start = -1;
  for (int t = 0; t < volume.tets.rows(); ++t) {
    if (!zone.tets[static_cast<std::size_t>(t)] || !crosses(volume, plane, t)) continue;
    if (start < 0 || stretches[t].least() > stretches[start].least()) start = t;
  }
  return start;
}

/// Whether the tracked features alone say that the two sides of the plane have parted.
bool parted(const std::vector<TearMark>& marks, const RestPlane& plane) {
  constexpr double kSure = 5.0;  // standard deviations
  const auto motions = sideMotions(marks);
  if (!motions) return false;
  const Eigen::Vector3d middle = 0.5 * (motions->above.rest + motions->below.rest);
  const double height = plane.normal.dot(middle - plane.point);
  return motions->partingAt(middle - height * plane.normal) > kSure;
}

}  // namespace

std::optional<CutPatch> TearWatch::follow(const TetTopology& volume, const MeshState& state,
                                          const std::vector<Target>& targets) {
  if (strain_ <= 0.0) return std::nullopt;
  const auto count = static_cast<std::size_t>(volume.tets.rows());
  if (revision_ != volume.revision || asked_at_.size() != count) asked_at_.assign(count, 0.0);
  revision_ = volume.revision;
  const std::vector<TetStretch> stretches = tetStretches(volume, state);
  int first = -1;
  for (std::size_t t = 0; t < count; ++t) {
    const bool beyond = stretches[t].stretch > 1.0 + strain_;
    if (!beyond) asked_at_[t] = 0.0;
    if (!beyond || stretches[t].stretch <= kFurther * asked_at_[t]) continue;
    if (first < 0 || stretches[t].least() > stretches[first].least()) first = static_cast<int>(t);
  }
  if (first < 0) return std::nullopt;
  const TearZone zone = tearZone(volume, stretches, first, kRuns * strain_);
  std::vector<TearMark> marks = tearMarks(volume, state.vertices, targets, strain_, zone);
  takeSides(zone, &marks);
  const RestPlane plane = tearPlane(zone, marks);
  if (stretches[first].least() <= 1.0 + strain_ && !parted(marks, plane)) return std::nullopt;
  asked_at_[static_cast<std::size_t>(first)] = stretches[first].stretch;
  const int start = startOf(volume, stretches, zone, plane);
  if (start < 0) return std::nullopt;
  std::vector<bool> torn;
  for (const double stretch : stretchAcross(volume, stretches, plane, marks))
    torn.push_back(stretch > 1.0 + kRuns * strain_);
  return planeSection(volume, plane.point, plane.normal, start, torn,
                      kOverhang * meanEdgeLength(volume.rest_vertices, volume.tets));
}

}  // namespace softbody
