#include "softbody_sim/simulator.h"

namespace softbody {

SimulatorConfig readSimulatorConfig(Parameters& parameters) {
  SimulatorConfig config;
  config.simulate = parameters.flag("simulate", config.simulate);
  config.iterations = parameters.integer("iterations", config.iterations, 1, 1000);
  config.tolerance = parameters.number("tolerance", config.tolerance, 0.0, 1.0);
  config.target_stiffness = parameters.number("target_stiffness", config.target_stiffness, 1e-6, 1e6);
  config.max_time_step_s = parameters.number("max_time_step_s", config.max_time_step_s, 1e-3, 10.0);
  const std::vector<double> gravity = parameters.numbers("gravity_m_s2", {0.0, 0.0, 0.0});
  config.gravity = {gravity[0], gravity[1], gravity[2]};
  return config;
}

}  // namespace softbody
