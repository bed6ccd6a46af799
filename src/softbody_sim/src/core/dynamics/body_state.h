#pragma once

#include <vector>

#include "constraints/contact_detection.h"
#include "cutting/volume/tet_edit.h"
#include "estimation/load_estimate.h"
#include "estimation/shape_memory.h"
#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/time_step/step_report.h"

namespace softbody {

/// Everything that a simulation step changes.
struct BodyState {
  bool placed = false;
  Nanoseconds stamp = 0;
  Points velocity;  ///< #V by 3 [m/s]
  LoadEstimate loads;
  RememberedShape memory;
  MeshState mesh;
  StepReport report;
  Reactions reactions;
  ContactState contact;  ///< at the end of the last step; without poses: no step yet
};

/// Places the rest shape at a pose, without velocity and loads.
void placeAtRest(const Points& rest_vertices, const Eigen::Isometry3d& pose, Nanoseconds stamp,
                 BodyState* body);

/// Interpolates the state to the vertices of an edited volume. Position and velocity of the material do not
/// change.
/// @param tets before the edit.
void transferToEdit(const TetEdit& edit, const Tets& tets, BodyState* body);

}  // namespace softbody
