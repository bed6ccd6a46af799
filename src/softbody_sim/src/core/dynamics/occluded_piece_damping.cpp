#include "dynamics/occluded_piece_damping.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

constexpr double kHalfLife = 0.1;  // [s]

OccludedPieceDamping::OccludedPieceDamping(const TetTopology& topology)
    : tet_pieces_(tetPieces(topology.tets, static_cast<int>(topology.rest_vertices.rows()))),
      vertex_pieces_(vertexPieces(topology.tets, tet_pieces_, topology.rest_vertices.rows())),
      observed_(*std::max_element(tet_pieces_.begin(), tet_pieces_.end()) + 1) {}

void OccludedPieceDamping::apply(const std::vector<Target>& targets, double elapsed_s, Points* velocities) {
  if (observed_.size() == 1 || targets.empty()) return;
  observed_.assign(observed_.size(), false);
  for (const Target& target : targets)
    observed_[tet_pieces_[static_cast<std::size_t>(target.place.tet)]] = true;
  const double rest = std::pow(0.5, elapsed_s / kHalfLife);
  for (Eigen::Index v = 0; v < velocities->rows(); ++v) {
    if (!observed_[vertex_pieces_[static_cast<std::size_t>(v)]]) velocities->row(v) *= rest;
  }
}

}  // namespace softbody
