#include "tools/simulate_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "softbody_sim/object/vertex_region.h"

namespace softbody {
namespace {

using Words = std::vector<std::string>;

CLI::Range rangeOf(const MaterialRange& range) { return {range.min, range.max}; }

void addMaterialOptions(CLI::App& app, SimulateOptions& o) {
  app.add_option("--young", o.material.youngs_modulus_pa, "Young's modulus [Pa]")
      ->check(rangeOf(kYoungsModulusRange))
      ->capture_default_str();
  app.add_option("--poisson", o.material.poisson_ratio, "Poisson's ratio")
      ->check(rangeOf(kPoissonRatioRange))
      ->capture_default_str();
  app.add_option("--density", o.material.density_kg_m3, "density [kg/m^3]")
      ->check(rangeOf(kDensityRange))
      ->capture_default_str();
  app.add_option("--damping", o.material.damping, "fraction of the velocity lost per 1/30 s")
      ->check(rangeOf(kDampingRange))
      ->capture_default_str();
  app.add_option(
         "--material", o.materials,
         "REGION YOUNG POISSON DENSITY: another material for the tets whose centre lies in a region; may "
         "be repeated, the last one counts")
      ->type_size(4);
  app.add_option("--elasticity", o.elasticity, "material model; neo_hookean and springs need the solver fem")
      ->check(CLI::IsMember(elasticityNames()))
      ->capture_default_str();
  app.add_option("--strain-smoothing", o.strain_smoothing,
                 "fraction of the shear energy with strains smoothed around the vertices")
      ->check(CLI::Range(0.0, 0.95))
      ->capture_default_str();
  app.add_option("--volume-smoothing", o.volume_smoothing,
                 "the same of the volume energy; default: from Poisson's ratio, so that the tets do not lock")
      ->check(CLI::Range(0.0, 1.0));
}

void addHeldOptions(CLI::App& app, SimulateOptions& o) {
  app.add_option("--pin", o.pins,
                 "holds the vertices of a region of the rest shape, for example "
                 "\"x<0.01 & z>0\" [m]; may be repeated");
  app.add_option(
         "--move", o.moves,
         "REGION DX DY DZ: holds a region and moves it by a vector [m], evenly over the steps; may be "
         "repeated")
      ->type_size(4);
  app.add_option(
         "--turn", o.turns,
         "REGION AX AY AZ DEGREES: holds a region and turns it about the axis (AX, AY, AZ) through the "
         "centre of its bounding box, evenly over the steps; may be repeated")
      ->type_size(5);
}

void addProblemOptions(CLI::App& app, SimulateOptions& o) {
  app.add_option("--gravity", o.gravity, "gravity X Y Z [m/s^2]")->expected(3);
  app.add_option("--load", o.region_loads,
                 "REGION FX FY FZ: a force [N], divided among the region's vertices; may be repeated")
      ->type_size(4);
  app.add_option("--loads", o.loads, "CSV file with rows vertex,fx,fy,fz [N]; the first vertex is 0")
      ->check(CLI::ExistingFile);
  app.add_option("--ground", o.ground, "height z [m] of a ground plane");
  app.add_option(
         "--pusher", o.pushers,
         "X Y Z SX SY SZ DX DY DZ: a box with this centre and these sizes, which the body cannot enter; it "
         "moves by a vector [m], evenly over the steps; may be repeated")
      ->type_size(9);
  app.add_option("--friction", o.friction, "coefficient of Coulomb friction of the ground plane")
      ->check(CLI::Range(0.0, 10.0))
      ->needs("--ground")
      ->capture_default_str();
  app.add_flag("--self-contact", o.self_contact, "parts of the body cannot enter each other");
  app.add_option("--self-friction", o.self_friction,
                 "coefficient of Coulomb friction where the body touches itself")
      ->check(CLI::Range(0.0, 10.0))
      ->needs("--self-contact")
      ->capture_default_str();
  app.add_option("--start", o.start, "initial shape")
      ->check(CLI::IsMember({"rest", "flat", "inside_out", "random"}))
      ->capture_default_str();
  app.add_option("--probe", o.probe,
                 "region whose mean displacement is printed; default: the vertex farthest "
                 "from the pins");
}

void addSolverOptions(CLI::App& app, SimulateOptions& o) {
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

double toNumber(const std::string& option, const std::string& text) {
  double value = 0.0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    throw CLI::ValidationError(option, "'" + text + "' is not a number");
  return value;
}

Eigen::Vector3d vectorOf(const std::string& option, const Words& words) {
  return {toNumber(option, words[1]), toNumber(option, words[2]), toNumber(option, words[3])};
}

/// The held regions in the order of the command line; --pin, --move and --turn of the same region are one.
std::vector<HeldRegion> heldRegionsOf(const SimulateOptions& o) {
  std::vector<HeldRegion> regions;
  const auto regionOf = [&regions](const std::string& name) -> HeldRegion& {
    const auto found = std::find_if(regions.begin(), regions.end(),
                                    [&name](const HeldRegion& held) { return held.region == name; });
    if (found != regions.end()) return *found;
    regions.push_back({name});
    return regions.back();
  };
  for (const std::string& name : o.pins) regionOf(name);
  for (const Words& words : o.moves) regionOf(words[0]).shift += vectorOf("--move", words);
  for (const Words& words : o.turns) {
    const Eigen::Vector3d axis = vectorOf("--turn", words);
    HeldRegion& held = regionOf(words[0]);
    if (axis.isZero(0.0)) throw CLI::ValidationError("--turn", "the axis of '" + words[0] + "' is 0 0 0");
    if (!held.turn.isZero(0.0))
      throw CLI::ValidationError("--turn", "'" + words[0] + "' turns twice; give one axis and one angle");
    constexpr double kDegree = M_PI / 180.0;
    held.turn = kDegree * toNumber("--turn", words[4]) * axis.normalized();
  }
  return regions;
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

}  // namespace

void addOptions(CLI::App* app, SimulateOptions* o) {
  app->add_option("MESH", o->mesh, "VTU, MSH, TetGen .node/.ele or VEG")->required();
  app->add_option("--unit", o->unit, "unit of the mesh")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  app->add_option("--output", o->output, "the table as .csv, or the last state as .vtu")
      ->check([](const std::string& path) {
        const auto extension = std::filesystem::path(path).extension();
        return extension == ".csv" || extension == ".vtu" ? "" : "allowed: a name that ends in .csv or .vtu";
      });
  addMaterialOptions(*app, *o);
  addHeldOptions(*app, *o);
  addProblemOptions(*app, *o);
  addSolverOptions(*app, *o);
}

SimulatorConfig configOf(const SimulateOptions& o) {
  SimulatorConfig config;
  config.gravity = Eigen::Vector3d(o.gravity.data());
  config.self_contact = o.self_contact;
  config.self_friction = o.self_friction;
  if (o.node_defaults) return config;
  config.solver = o.solver == "fem" ? SolverKind::kFem : SolverKind::kProjectiveDynamics;
  config.elasticity = elasticityFromName(o.elasticity);
  config.strain_smoothing = o.strain_smoothing;
  config.volume_smoothing = o.volume_smoothing;
  // Projective dynamics needs more iterations, the more incompressible the material is; each is cheap.
  config.iterations = o.iterations.value_or(o.solver == "fem" ? 200 : 20000);
  config.tolerance = o.tolerance;
  config.max_time_step_s = o.time_step_s;
  return config;
}

Material materialOf(const SimulateOptions& o) {
  Material material = o.material;
  for (const Words& words : o.materials) {
    const Eigen::AlignedBox3d box = boxOf(words[0]);
    const Eigen::Vector3d values = vectorOf("--material", words);
    material.regions.push_back({box.min(), box.max(), values[0], values[1], values[2]});
  }
  return material;
}

void requireUsable(const SimulateOptions& o) {
  try {
    requireConsistent(configOf(o));
    requireUsable(materialOf(o));
    for (const HeldRegion& held : heldRegionsOf(o)) boxOf(held.region);
    if (!o.probe.empty()) boxOf(o.probe);
    for (const Words& load : o.region_loads) {
      boxOf(load[0]);
      vectorOf("--load", load);
    }
    for (const std::vector<double>& pusher : o.pushers)
      if (!(std::min({pusher[3], pusher[4], pusher[5]}) > 0.0))
        throw CLI::ValidationError("--pusher", "its sizes must be above 0");
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("simulate", error.what());
  }
}

HeldRegions heldRegionsOf(const SimulateOptions& o, const Points& rest) {
  constexpr double kNodePinAccuracy_m = 0.001;  // pin_accuracy_m of the node
  return {heldRegionsOf(o), rest, o.node_defaults ? kNodePinAccuracy_m : 0.0};
}

Points loadsOf(const SimulateOptions& o, const Points& rest) {
  Points loads = Points::Zero(rest.rows(), 3);
  for (const Words& load : o.region_loads) {
    const std::vector<int> vertices = verticesWhere(load[0], rest);
    const Eigen::RowVector3d force = vectorOf("--load", load).transpose();
    for (int v : vertices) loads.row(v) += force / static_cast<double>(vertices.size());
  }
  if (!o.loads.empty()) addLoadsOfFile(o.loads, &loads);
  return loads;
}

}  // namespace softbody
