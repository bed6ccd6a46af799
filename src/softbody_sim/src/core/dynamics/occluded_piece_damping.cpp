#include "dynamics/occluded_piece_damping.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/tet_geometry.h"

namespace softbody {

constexpr double kHalfLife = 0.1;  // [s]

OccludedPieceDamping::OccludedPieceDamping(const TetTopology& topology)
    : tet_bodies_(tetBodies(topology.tets, static_cast<int>(topology.rest_vertices.rows()))),
      vertex_bodies_(vertexBodies(topology.tets, tet_bodies_, topology.rest_vertices.rows())),
      seen_(*std::max_element(tet_bodies_.begin(), tet_bodies_.end()) + 1) {}

void OccludedPieceDamping::apply(const std::vector<Target>& targets, double elapsed_s, Points* velocities) {
  if (seen_.size() == 1 || targets.empty()) return;
  seen_.assign(seen_.size(), false);
  for (const Target& target : targets) seen_[tet_bodies_[static_cast<std::size_t>(target.place.tet)]] = true;
  const double rest = std::pow(0.5, elapsed_s / kHalfLife);
  for (Eigen::Index v = 0; v < velocities->rows(); ++v) {
    if (!seen_[vertex_bodies_[static_cast<std::size_t>(v)]]) velocities->row(v) *= rest;
  }
}

}  // namespace softbody
