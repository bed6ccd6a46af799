#pragma once

#include <string>
#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "softbody_common/types.h"
#include "time_step/incremental_potential.h"

namespace softbody::bench {

/// A body in a bent and disordered state, under a hundred targets that bend it further.
struct BentBody {
  std::string name;
  TetTopology topology;
  Lame lame;
  double edge_length = 0.0;  ///< mean [m]
  IncrementalPotential potential;
  Points start;
};

/// @param name sponge, doll (of the shipped doll, with a cage of about 150 vertices), 1k, 10k or 100k (boxes
/// of about as many tets).
TetTopology bodyTopology(const std::string& name);

/// Bent about y to a curvature [1/m]. @param rest #V by 3 [m].
Points bent(const Points& rest, double curvature);

/// @param name as bodyTopology's. @param poisson_ratio 0: no volume term.
BentBody bentBody(const std::string& name, double poisson_ratio);

}  // namespace softbody::bench
