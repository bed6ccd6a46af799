#include "softbody_recordings/tools/identify_material.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "identification/estimate_output.h"
#include "identification/shape_question.h"
#include "softbody_common/run_tool.h"
#include "softbody_recordings/ros/graph_config.h"

namespace softbody {
namespace {

constexpr int kNotObservable = 3;  ///< exit code: done, but a property that was asked for does not show

struct Arguments {
  std::string parameters, shape_unit = "m";
  std::vector<std::string> free{"e"};
  std::vector<double> gravity{0.0, 0.0, -9.81};
  std::vector<std::vector<std::string>> loads;
  FileScope scope = FileScope::kOwnFolder;
  ShapeQuestion shape;
  EstimateOutput output;
};

void declareObject(CLI::App* app, Arguments* arguments) {
  app->add_option("--object", arguments->output.object, "object YAML, or its folder")
      ->required()
      ->check(CLI::ExistingPath);
  app->add_option("--parameters", arguments->parameters,
                  "YAML with a section of parameters for each node; those of the simulator count")
      ->check(CLI::ExistingFile);
  CLI::Option* mass =
      app->add_option("--mass", arguments->shape.material.mass_kg, "mass of the whole object [kg], weighed")
          ->check(CLI::PositiveNumber);
  app->add_option("--mass-std", arguments->shape.material.mass_std_kg,
                  "standard deviation of the mass [kg]; default: a hundredth of it")
      ->check(CLI::PositiveNumber)
      ->needs(mass);
  app->add_option("--free", arguments->free, "what to find: e, nu, damping")
      ->delimiter(',')
      ->capture_default_str();
  app->add_option(
      "--output", arguments->output.yaml,
      "gets the object YAML with the found material; in the object's folder, may be the object itself");
  app->add_option("--report", arguments->output.folder, "folder that gets report.txt and fit.png");
  addAllowOutside(app, &arguments->scope);
}

void declareShape(CLI::App* app, Arguments* arguments) {
  CLI::Option* shape =
      app->add_option("--from-shape", arguments->shape.shape,
                      "PLY, OBJ, STL or OFF: points on the surface of the body at rest under its "
                      "loads, in the object's frame; the held part lies on the object's")
          ->required()
          ->check(CLI::ExistingFile);
  app->add_option("--shape-unit", arguments->shape_unit, "unit of that file")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->needs(shape)
      ->capture_default_str();
  app->add_option("--pin", arguments->shape.pins,
                  "region of the rest shape that is held, for example \"x<0.01 & z>0\" [m]; may be repeated")
      ->needs(shape);
  app->add_option("--load", arguments->loads,
                  "REGION FX FY FZ: a known force [N], divided among the region's vertices; may be repeated")
      ->type_size(4)
      ->needs(shape);
  app->add_option("--gravity", arguments->gravity, "gravity X Y Z in the object's frame [m/s^2]")
      ->expected(3)
      ->needs(shape)
      ->capture_default_str();
}

RegionLoad loadOf(const std::vector<std::string>& words) {
  RegionLoad load{words[0], {}};
  for (int k = 0; k < 3; ++k)
    if (!CLI::detail::lexical_cast(words[static_cast<std::size_t>(k) + 1], load.force[k]))
      throw CLI::ValidationError("--load",
                                 "'" + words[static_cast<std::size_t>(k) + 1] + "' is not a number");
  return load;
}

/// @throw CLI::ValidationError.
void read(Arguments* arguments) {
  try {
    arguments->shape.material.free = freePropertiesOf(arguments->free);
    requireUsable(arguments->output);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
  for (const auto& words : arguments->loads) arguments->shape.loads.push_back(loadOf(words));
  arguments->shape.unit_m = metresPer(arguments->shape_unit);
}

int identify(Arguments* arguments) {
  const auto warn = [](const std::string& sentence) {
    fmt::print(stderr, "identify_material: {}\n", sentence);
  };
  const ObjectDescription description = loadObjectDescription(arguments->output.object, arguments->scope);
  const ObjectModel model = buildObjectModel(description);
  std::vector<std::string> warnings = model.warnings;
  SimulatorConfig& simulator = arguments->shape.material.simulator;
  simulator = readGraphConfig(arguments->parameters, &warnings).pipeline.simulator;
  for (const std::string& warning : warnings) warn(warning);
  simulator.gravity = Eigen::Vector3d(arguments->gravity.data());
  const MaterialAnswer found =
      answer(arguments->shape, description, model, warn, ProgressLine("identify_material"));
  const std::string report = reportOf(found.estimate);
  fmt::print("{}", report);
  fmt::print("{}", write(arguments->output, found.problem, found.estimate, report));
  return isComplete(found.estimate) ? 0 : kNotObservable;
}

}  // namespace

int runIdentifyMaterial(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Finds the stiffness of an object where its weight or a known force shows it");
  declareObject(&app, &arguments);
  declareShape(&app, &arguments);
  app.callback([&arguments] { read(&arguments); });
  app.footer(
      "Exit codes: 0 found; 1 the data could not be processed; 2 wrong usage; 3 done, but a property that "
      "was asked "
      "for does not show in the data.");
  return runTool(&app, argc, argv, [&arguments] { return identify(&arguments); });
}

}  // namespace softbody
