#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <limits>
#include <random>

#include "softbody_common/files/staged_output.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/object/vertex_region.h"
#include "tools/simulate_options.h"
#include "tools/simulation_problem.h"
#include "tools/simulation_table.h"
#include "tools/static_solution.h"

namespace {

using namespace softbody;

TetTopology loadTopology(const SimulateOptions& o) {
  Warnings warnings;
  TetMesh mesh = readTetFile(o.mesh, &warnings);
  for (const std::string& warning : warnings) std::cerr << "simulate: " << warning << '\n';
  TetTopology topology;
  topology.rest_vertices = metresPer(o.unit) * mesh.vertices;
  topology.tets = mesh.tets;
  topology.surface = boundaryTriangles(mesh.tets);
  return topology;
}

Points startOf(const SimulateOptions& o, const Points& rest) {
  Points start = rest;
  if (o.start == "flat") start.col(2).setConstant(rest.col(2).mean());
  if (o.start == "inside_out") start = -rest;
  if (o.start == "random") {
    std::mt19937 random(1);
    const double size = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff();
    std::uniform_real_distribution<double> uniform(-0.5 * size, 0.5 * size);
    start = start.unaryExpr([&](double) { return uniform(random); });
  }
  return start;
}

std::vector<int> probeOf(const SimulateOptions& o, const Points& rest, const std::vector<Pin>& pins) {
  if (!o.probe.empty()) return verticesWhere(o.probe, rest);
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(rest.rows(), std::numeric_limits<double>::max());
  for (const Pin& pin : pins)
    distance = distance.cwiseMin((rest.rowwise() - pin.position.transpose()).rowwise().norm());
  int farthest = 0;
  distance.maxCoeff(&farthest);
  return {farthest};
}

/// Static equilibrium, or time steps. @return the last step's report.
StepReport simulate(const SimulateOptions& o, const SimulationProblem& problem, const SimulationTable& table,
                    Simulator* simulator, std::string* rows) {
  const auto print = [rows](const std::string& line) {
    *rows += line;
    std::cout << line << std::flush;
  };
  print(table.header());
  if (o.until_rest) {
    const int settles = o.node_defaults ? 20 : 1;  // then pd has 20,000 iterations, as without the option
    const StepReport report = settleInSteps(problem, settles, simulator);
    print(table.row(1, 0.0, 0.0, simulator->state().vertices, 1.0, report, *simulator));
    return report;
  }
  for (int step = 1; step <= o.steps; ++step) {
    const double time_s = step * o.time_step_s, share = static_cast<double>(step) / o.steps;
    const Points before = simulator->state().vertices;
    simulator->step({}, static_cast<Nanoseconds>(1e9 * time_s), problem.at(share));
    print(table.row(step, time_s, o.time_step_s, before, share, simulator->report(), *simulator));
  }
  return simulator->report();
}

void writeOutput(const std::string& path, const std::string& table, const TetMesh& mesh) {
  replaceFile(path, std::filesystem::path(path).extension() == ".vtu" ? vtuText(mesh) : table);
}

int run(const SimulateOptions& o) {
  const TetTopology topology = loadTopology(o);
  Simulator simulator(topology, materialOf(o), configOf(o));
  const SimulationProblem problem(o, topology.rest_vertices);
  TargetSet placing;
  placing.reset = true;
  simulator.step(placing, 0);
  simulator.setVertices(startOf(o, topology.rest_vertices));
  const SimulationTable table(problem, probeOf(o, topology.rest_vertices, problem.at(0.0).pins));

  std::string rows;
  const StepReport report = simulate(o, problem, table, &simulator, &rows);
  std::cerr << describeHeld(problem.held, 1.0, simulator);
  const Points& x = simulator.state().vertices;
  if (const int inverted = invertedTets(x, topology.tets); inverted > 0)
    std::cerr << fmt::format("simulate: {} of {} tets are inside out at the end\n", inverted,
                             topology.tets.rows());
  if (!o.output.empty()) writeOutput(o.output, rows, {x, topology.tets});
  if (o.until_rest && !report.converged) {
    throw std::runtime_error(fmt::format(
        "no equilibrium after {} iterations: {:.3g} N of {:.3g} N are not balanced. More "
        "--iterations or a larger --tolerance may help; a body that nothing holds has no equilibrium",
        report.iterations, report.residual_n, report.external_n));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Simulates a tet mesh under gravity, loads, held regions and obstacles, in time steps or to static "
      "equilibrium. "
      "Prints one CSV row per step: mean displacement of the probe, elastic energy, sum of the unbalanced "
      "forces, "
      "volume, sum of the forces on the pins, iterations, largest speed, depth in the obstacles; then the "
      "force and "
      "torque of the body on each held region, in the order of the options, and its force on each obstacle."};
  SimulateOptions options;
  addOptions(&app, &options);
  app.callback([&] { requireUsable(options); });
  return runTool(&app, argc, argv, [&] { return run(options); });
}
