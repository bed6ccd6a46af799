#include "tools/static_solution.h"

#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

StepReport settle(const Surroundings& surroundings, int most, Simulator* simulator) {
  StepReport report;
  for (int k = 0; k < most && !report.converged; ++k) {
    const int iterations = report.iterations;
    simulator->settle({}, surroundings);
    report = simulator->report();
    if (report.iterations == 0) return report;  // nothing moves any more
    report.iterations += iterations;
  }
  return report;
}

}  // namespace

int invertedTets(const Points& vertices, const Tets& tets) {
  return static_cast<int>((tetVolumes(vertices, tets).array() <= 0.0).count());
}

StepReport settleInSteps(const SimulationProblem& problem, int settles_per_step, Simulator* simulator) {
  constexpr int kAttempts = 3, kShorter = 4;  // up to 16 times as many steps
  const TetTopology& topology = simulator->topology();
  const Points start = simulator->state().vertices;
  const int inverted = invertedTets(start, topology.tets);
  const double edge = meanEdgeLength(topology.rest_vertices, topology.tets);
  int steps = std::max(1, static_cast<int>(std::ceil(problem.longestWay() / edge))), iterations = 0;
  for (int attempt = 1;; ++attempt, steps *= kShorter) {
    StepReport report;
    for (int step = 1; step <= steps; ++step) {
      report = settle(problem.at(static_cast<double>(step) / steps), settles_per_step, simulator);
      iterations += report.iterations;
    }
    report.iterations = iterations;
    const bool good =
        report.converged && invertedTets(simulator->state().vertices, topology.tets) <= inverted;
    if (good || attempt == kAttempts || problem.longestWay() == 0.0) return report;
    simulator->setVertices(start);
  }
}

}  // namespace softbody
