#pragma once

#include <string>
#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "softbody_common/geometry/types.h"
#include "tets/tet_matrix.h"
#include "time_step/incremental_potential.h"

namespace softbody::bench {

/// A bent body with random displacements, and a hundred targets that bend it further.
struct BentBody {
  TetTopology topology;
  Lame lame;
  double edge_length = 0.0;  ///< mean [m]
  IncrementalPotential potential;
  Points start;
};

/// @param name sponge, doll (the shipped doll with about 150 cage vertices), or 1k, 10k, 100k (boxes with
/// about that many tets).
TetTopology bodyTopology(const std::string& name);

/// The rest shape bent about y. @param rest #V by 3 [m]. @param curvature [1/m].
Points bent(const Points& rest, double curvature);

/// @param poisson_ratio 0: no volume term.
BentBody bentBody(const TetTopology& topology, double poisson_ratio);

/// The matrix of its global step, see ProjectiveDynamics.
TetMatrix metricOf(const BentBody& body);

}  // namespace softbody::bench
