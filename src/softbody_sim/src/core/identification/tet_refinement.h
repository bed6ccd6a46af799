#pragma once

#include <vector>

#include "identification/forward_model.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// Each tet in eight: four at its corners, and the octahedron between them in four along its shortest
/// diagonal.
struct RefinedTets {
  TetTopology topology;               ///< the first vertices are those before, in their order
  std::vector<Eigen::Vector2i> ends;  ///< per further vertex: the edge whose middle it is
};

/// @param topology with positive volumes. The volume and the boundary's shape stay.
RefinedTets refine(const TetTopology& topology);

/// The same problem on the refined mesh. A middle between two pins is a pin.
MaterialProblem refine(const MaterialProblem& problem);

}  // namespace softbody
