#include <iostream>

#include "softbody_sim/dynamics/simulator.h"
#include "softbody_tracking/tracker/body_tracker.h"

/// Lets a tet fall for 10 ms, and hands it to a tracker.
int main() {
  softbody::TetTopology tet;
  tet.rest_vertices.resize(4, 3);
  tet.rest_vertices << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1;
  tet.tets.resize(1, 4);
  tet.tets << 0, 1, 2, 3;
  tet.surface.resize(4, 3);
  tet.surface << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  softbody::Simulator simulator(tet, {}, {});
  softbody::TargetSet targets;
  targets.reset = true;
  simulator.step(targets, 1000000000);
  simulator.step({}, 1010000000);
  softbody::BodyTracker tracker({});
  std::cout << simulator.state().vertices.row(3) << '\n';
  return simulator.state().vertices.allFinite() && !tracker.ready() ? 0 : 1;
}
