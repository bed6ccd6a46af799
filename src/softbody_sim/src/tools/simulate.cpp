#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>

#include "softbody_common/files/staged_output.h"
#include "softbody_common/run_tool.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/object_description.h"
#include "tools/vertex_region.h"

namespace {

using namespace softbody;

struct Options {
  std::string mesh, unit = "m", solver = "fem", elasticity = "corotated", start = "rest", probe, output,
                    loads;
  Material material{2.0e4, 0.2, 30.0, 0.1};
  std::vector<double> gravity{0.0, 0.0, 0.0};
  std::vector<std::string> pins;
  std::vector<std::vector<std::string>> region_loads;
  double ground = std::numeric_limits<double>::quiet_NaN(), friction = 0.0, self_friction = 0.0;
  bool until_rest = false, node_defaults = false;
  int steps = 100;
  std::optional<int> iterations;
  double time_step_s = 1.0 / 30.0, tolerance = 1e-5, strain_smoothing = SimulatorConfig().strain_smoothing;
  std::optional<double> volume_smoothing;
};

void addMaterialOptions(CLI::App& app, Options& o) {
  app.add_option("--young", o.material.youngs_modulus_pa, "Young's modulus [Pa]")
      ->check(CLI::Range(1.0, 1e12))
      ->capture_default_str();
  app.add_option("--poisson", o.material.poisson_ratio, "Poisson's ratio")
      ->check(CLI::Range(0.0, 0.495))
      ->capture_default_str();
  app.add_option("--density", o.material.density_kg_m3, "density [kg/m^3]")
      ->check(CLI::Range(0.1, 30000.0))
      ->capture_default_str();
  app.add_option("--damping", o.material.damping, "fraction of the velocity lost per 1/30 s")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--elasticity", o.elasticity, "material model; neo_hookean needs the solver fem")
      ->check(CLI::IsMember({"corotated", "neo_hookean"}))
      ->capture_default_str();
  app.add_option("--strain-smoothing", o.strain_smoothing,
                 "fraction of the shear energy with strains smoothed around the vertices")
      ->check(CLI::Range(0.0, 0.95))
      ->capture_default_str();
  app.add_option("--volume-smoothing", o.volume_smoothing,
                 "the same of the volume energy; default: from Poisson's ratio, so that the tets do not lock")
      ->check(CLI::Range(0.0, 1.0));
}

void addProblemOptions(CLI::App& app, Options& o) {
  app.add_option("--gravity", o.gravity, "gravity X Y Z [m/s^2]")->expected(3);
  app.add_option("--pin", o.pins,
                 "holds the vertices of a region of the rest shape, for example "
                 "\"x<0.01 & z>0\" [m]; may be repeated");
  app.add_option("--load", o.region_loads,
                 "REGION FX FY FZ: a force [N], divided among the region's vertices; may be repeated")
      ->type_size(4);
  app.add_option("--loads", o.loads, "CSV file with rows vertex,fx,fy,fz [N]; the first vertex is 0")
      ->check(CLI::ExistingFile);
  app.add_option("--ground", o.ground, "height z [m] of a ground plane");
  app.add_option("--friction", o.friction, "coefficient of Coulomb friction of the ground plane")
      ->check(CLI::Range(0.0, 10.0))
      ->needs("--ground")
      ->capture_default_str();
  app.add_option("--self-friction", o.self_friction,
                 "coefficient of Coulomb friction where the body touches itself")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--start", o.start, "initial shape")
      ->check(CLI::IsMember({"rest", "flat", "inside_out", "random"}))
      ->capture_default_str();
  app.add_option("--probe", o.probe,
                 "region whose mean displacement is printed; default: the vertex farthest "
                 "from the pins");
}

void addSolverOptions(CLI::App& app, Options& o) {
  app.add_option("--solver", o.solver, "pd: projective dynamics; fem: finite elements")
      ->check(CLI::IsMember({"pd", "fem"}))
      ->capture_default_str();
  app.add_flag("--static", o.until_rest, "static equilibrium instead of time steps");
  app.add_option("--steps", o.steps, "number of time steps")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--time-step", o.time_step_s, "time step [s]")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  app.add_option("--iterations", o.iterations,
                 "maximum number of iterations per step; default: 200 of fem, 20000 of pd")
      ->check(CLI::Range(1, 100000));
  app.add_option("--tolerance", o.tolerance,
                 "a step has converged when the unbalanced forces are this share of the external ones")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag(
         "--node-defaults", o.node_defaults,
         "every setting as the node simulator without parameters; material, gravity and problem as given")
      ->excludes("--solver", "--iterations", "--tolerance", "--elasticity", "--strain-smoothing",
                 "--volume-smoothing");
}

SimulatorConfig configOf(const Options& o) {
  SimulatorConfig config;
  config.gravity = Eigen::Vector3d(o.gravity.data());
  config.self_friction = o.self_friction;
  if (o.node_defaults) return config;
  config.solver = o.solver == "fem" ? SolverKind::kFem : SolverKind::kProjectiveDynamics;
  config.elasticity = o.elasticity == "corotated" ? Elasticity::kCorotated : Elasticity::kNeoHookean;
  config.strain_smoothing = o.strain_smoothing;
  config.volume_smoothing = o.volume_smoothing;
  // Projective dynamics needs more iterations, the more incompressible the material is; each is cheap.
  config.iterations = o.iterations.value_or(o.solver == "fem" ? 200 : 20000);
  config.tolerance = o.tolerance;
  config.max_time_step_s = o.time_step_s;
  return config;
}

double toNumber(const std::string& text) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    throw CLI::ValidationError("--load", "'" + text + "' is not a number");
  return value;
}

/// Checks options together. @throw CLI::ValidationError.
void requireUsable(const Options& o) {
  try {
    requireConsistent(configOf(o));
    for (const std::string& region : o.pins) requireRegion(region);
    if (!o.probe.empty()) requireRegion(o.probe);
    for (const std::vector<std::string>& load : o.region_loads) {
      requireRegion(load[0]);
      for (std::size_t k = 1; k < load.size(); ++k) toNumber(load[k]);
    }
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("simulate", error.what());
  }
}

TetTopology loadTopology(const Options& o) {
  Warnings warnings;
  TetMesh mesh = readTetFile(o.mesh, &warnings);
  for (const std::string& warning : warnings) std::cerr << "simulate: " << warning << '\n';
  TetTopology topology;
  topology.rest_vertices = metresPer(o.unit) * mesh.vertices;
  topology.tets = mesh.tets;
  topology.surface = boundaryTriangles(mesh.tets);
  return topology;
}

void addLoadsOfFile(const std::string& path, Points* loads) {
  std::ifstream file(path);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    int vertex = -1;
    double x = 0.0, y = 0.0, z = 0.0;
    if (std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &vertex, &x, &y, &z) != 4 || vertex < 0 ||
        vertex >= loads->rows()) {
      throw std::invalid_argument(
          fmt::format("{}:{}: '{}'; allowed: vertex,fx,fy,fz with a vertex from 0 to {}", path, number, line,
                      loads->rows() - 1));
    }
    loads->row(vertex) += Eigen::RowVector3d(x, y, z);
  }
}

Surroundings surroundingsOf(const Options& o, const Points& rest) {
  Surroundings surroundings;
  for (const std::string& region : o.pins) {
    for (int v : verticesWhere(region, rest)) surroundings.pins.push_back({v, rest.row(v)});
  }
  surroundings.loads = Points::Zero(rest.rows(), 3);
  for (const std::vector<std::string>& load : o.region_loads) {
    const std::vector<int> vertices = verticesWhere(load[0], rest);
    const Eigen::RowVector3d force(toNumber(load[1]), toNumber(load[2]), toNumber(load[3]));
    for (int v : vertices) surroundings.loads.row(v) += force / static_cast<double>(vertices.size());
  }
  if (!o.loads.empty()) addLoadsOfFile(o.loads, &surroundings.loads);
  if (!std::isnan(o.ground)) {
    surroundings.obstacles = {Obstacle::plane()};
    surroundings.obstacles[0].pose.translation().z() = o.ground;
    surroundings.obstacles[0].friction = o.friction;
  }
  return surroundings;
}

Points startOf(const Options& o, const Points& rest) {
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

std::vector<int> probeOf(const Options& o, const Points& rest, const std::vector<Pin>& pins) {
  if (!o.probe.empty()) return verticesWhere(o.probe, rest);
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(rest.rows(), std::numeric_limits<double>::max());
  for (const Pin& pin : pins)
    distance = distance.cwiseMin((rest.rowwise() - pin.position.transpose()).rowwise().norm());
  int farthest = 0;
  distance.maxCoeff(&farthest);
  return {farthest};
}

constexpr char kHeader[] =
    "step,time_s,probe_x_m,probe_y_m,probe_z_m,elastic_energy_j,residual_n,volume_m3,"
    "pins_x_n,pins_y_n,pins_z_n,iterations,converged\n";

std::string row(int step, double time_s, const Simulator& simulator, const std::vector<int>& probe) {
  const TetTopology& topology = simulator.topology();
  const Points& x = simulator.state().vertices;
  Eigen::RowVector3d tip = Eigen::RowVector3d::Zero(), held = tip;
  for (int v : probe) tip += (x.row(v) - topology.rest_vertices.row(v)) / static_cast<double>(probe.size());
  for (const Wrench& pin : simulator.reactions().pins) held += pin.force.transpose();
  const StepReport& report = simulator.report();
  return fmt::format("{},{:.6g},{:.9g},{:.9g},{:.9g},{:.9g},{:.3g},{:.9g},{:.6g},{:.6g},{:.6g},{},{}\n", step,
                     time_s, tip.x(), tip.y(), tip.z(), simulator.elasticEnergy(), report.residual_n,
                     tetVolumes(x, topology.tets).sum(), held.x(), held.y(), held.z(), report.iterations,
                     report.converged ? 1 : 0);
}

void writeOutput(const std::string& path, const std::string& table, const TetMesh& mesh) {
  replaceFile(path, std::filesystem::path(path).extension() == ".vtu" ? vtuText(mesh) : table);
}

int run(const Options& o) {
  const TetTopology topology = loadTopology(o);
  Simulator simulator(topology, o.material, configOf(o));
  const Surroundings surroundings = surroundingsOf(o, topology.rest_vertices);
  const std::vector<int> probe = probeOf(o, topology.rest_vertices, surroundings.pins);
  TargetSet placing;
  placing.reset = true;
  simulator.step(placing, 0);
  simulator.setVertices(startOf(o, topology.rest_vertices));

  std::string table = kHeader;
  std::cout << table;
  for (int step = 1; step <= (o.until_rest ? 1 : o.steps); ++step) {
    const double time_s = step * o.time_step_s;
    if (o.until_rest)
      simulator.settle({}, surroundings);
    else
      simulator.step({}, static_cast<Nanoseconds>(1e9 * time_s), surroundings);
    const std::string line = row(step, o.until_rest ? 0.0 : time_s, simulator, probe);
    table += line;
    std::cout << line << std::flush;
  }
  if (!o.output.empty()) writeOutput(o.output, table, {simulator.state().vertices, topology.tets});
  const StepReport& report = simulator.report();
  if (o.until_rest && !report.converged) {
    throw std::runtime_error(
        fmt::format("no equilibrium after {} iterations: {:.3g} N of {:.3g} N are not balanced. More "
                    "--iterations or a larger "
                    "--tolerance may help; a body that nothing holds has no equilibrium",
                    report.iterations, report.residual_n, report.external_n));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Simulates a tet mesh under gravity, loads, pins and a ground plane, in time steps or to static "
      "equilibrium. "
      "Prints one CSV row per step: mean displacement of the probe, elastic energy, sum of the "
      "unbalanced forces, volume, force on the pins, iterations."};
  Options options;
  app.add_option("MESH", options.mesh, "VTU, MSH, TetGen .node/.ele or VEG")->required();
  app.add_option("--unit", options.unit, "unit of the mesh")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  app.add_option("--output", options.output, "the table as .csv, or the last state as .vtu")
      ->check([](const std::string& path) {
        const auto extension = std::filesystem::path(path).extension();
        return extension == ".csv" || extension == ".vtu" ? "" : "allowed: a name that ends in .csv or .vtu";
      });
  addMaterialOptions(app, options);
  addProblemOptions(app, options);
  addSolverOptions(app, options);
  app.callback([&] { requireUsable(options); });
  return runTool(&app, argc, argv, [&] { return run(options); });
}
