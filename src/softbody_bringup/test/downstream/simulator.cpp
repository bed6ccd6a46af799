#include "softbody_sim/dynamics/simulator.h"

#include <iostream>

#include "softbody_sim/object/object_model.h"

/// Holds one end of the sponge, and prints how far the other one sags.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  softbody::SimulatorConfig config;
  config.gravity = {0.0, 0.0, -9.81};
  softbody::Simulator simulator(model.volume, model.material, config);
  softbody::TargetSet start;
  start.reset = true;  // places the rest shape
  simulator.step(start, 1);
  const softbody::Points& rest = model.volume.rest_vertices;
  softbody::Surroundings surroundings;
  for (int v = 0; v < rest.rows(); ++v)
    if (rest(v, 0) < -0.08) surroundings.pins.push_back({v, rest.row(v).transpose()});
  simulator.settle({}, surroundings);
  const double sag = (rest - simulator.state().vertices).col(2).maxCoeff();
  std::cout << "it sags by " << 1000.0 * sag << " mm\n";
  return sag > 0.0 ? 0 : 1;
}
