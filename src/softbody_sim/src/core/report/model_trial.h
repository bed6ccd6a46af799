#pragma once

#include <string>
#include <vector>

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Milliseconds that a frame takes on this machine, each the median of several frames.
struct FrameCost {
  double simulation_ms = 0.0;
  double surface_ms = 0.0;  ///< visual vertices, their normals and the message
  double drawing_ms = 0.0;  ///< the visual mesh once in 640 x 480, as the tracker does

  double total() const { return simulation_ms + surface_ms + drawing_ms; }
};

/// What happened when a prepared model was used: bound, simulated for a second, and cut.
struct ModelTrial {
  std::string failure;                    ///< why it cannot be used at all; empty: it can
  std::vector<std::string> refused_cuts;  ///< plane and reason
  double volume_error = 0.0;              ///< of the pieces of a cut from the whole, over the whole
  int crossings = 0;                      ///< pairs of visual triangles that cross each other
  Eigen::Vector3d crossing = Eigen::Vector3d::Zero();  ///< where one pair does [m]
  double simulated_s = 0.0;                            ///< less than 1 if the time for the trial was over
  int inverted = 0;                                    ///< tets that are inverted at the end
  double energy_growth = 0.0;  ///< largest elastic energy over that at the start; above 1, it explodes
  FrameCost cost;
};

/// Stretches the body by a tenth, lets it go, and simulates a second of free motion at 30 Hz. Previews cuts
/// by three planes through the middle of its largest piece. Takes seconds at most, more only for a mesh of
/// hundreds of thousands of triangles.
ModelTrial tryModel(const ObjectModel& model);

}  // namespace softbody
