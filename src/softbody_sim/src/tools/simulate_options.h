#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/dynamics/simulator_config.h"
#include "softbody_sim/object/material.h"
#include "tools/held_regions.h"

namespace softbody {

/// The command line of `simulate`.
struct SimulateOptions {
  std::string mesh, unit = "m", solver = "fem", elasticity = "corotated", start = "rest", probe, output,
                    loads;
  Material material{2.0e4, 0.2, 30.0, 0.1};
  std::vector<double> gravity{0.0, 0.0, 0.0};
  std::vector<std::string> pins;
  std::vector<std::vector<std::string>> materials, moves, turns, region_loads;
  std::vector<std::vector<double>> pushers;
  double ground = std::numeric_limits<double>::quiet_NaN(), friction = 0.0, self_friction = 0.0;
  bool self_contact = false;
  bool until_rest = false, node_defaults = false;
  int steps = 100;
  std::optional<int> iterations;
  double time_step_s = 1.0 / 30.0, tolerance = 1e-5, strain_smoothing = SimulatorConfig().strain_smoothing;
  std::optional<double> volume_smoothing;
};

void addOptions(CLI::App* app, SimulateOptions* options);

/// Checks options together. @throw CLI::ValidationError.
void requireUsable(const SimulateOptions& options);

// Only after requireUsable():
SimulatorConfig configOf(const SimulateOptions& options);
Material materialOf(const SimulateOptions& options);
HeldRegions heldRegionsOf(const SimulateOptions& options, const Points& rest);
/// Forces on the vertices of a mesh at rest [N], #V by 3.
/// @throw std::invalid_argument with file and line, or the region that has no vertex.
Points loadsOf(const SimulateOptions& options, const Points& rest);

}  // namespace softbody
