#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "cage/fill_request.h"
#include "report/model_folder.h"
#include "softbody_common/run_tool.h"
#include "tools/surface_filling.h"

namespace {

/// "200mm" in metres. @throw CLI::ValidationError
double lengthOf(const std::string& text) {
  std::size_t end = 0;
  double number = 0.0;
  try {
    number = std::stod(text, &end);
  } catch (const std::logic_error&) {
  }
  const std::string unit = text.substr(end);
  if (!(number > 0.0) || !std::isfinite(number) ||
      (unit != "m" && unit != "cm" && unit != "mm" && unit != "inch"))
    throw CLI::ValidationError(
        "--length", "is '" + text + "'; allowed: a number above 0 with m, cm, mm or inch, e.g. 200mm");
  return number * softbody::metresPer(unit);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == softbody::kFillArgument) return softbody::answerFillRequest();
  CLI::App app{
      "Makes an object folder from a surface mesh: visual mesh, cage, tet mesh, object.yaml and report."};
  softbody::ModelSource source;
  std::string output;
  softbody::VolumeSettings settings;
  settings.use_cache = false;
  settings.progress = softbody::ProgressLine("prepare_model");
  app.add_option("MESH", source.mesh, "OBJ, PLY, STL or OFF")->required();
  app.add_option("--output", output, "output folder")->required();
  CLI::Option* unit = app.add_option("--unit", source.unit, "unit of the mesh")
                          ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
                          ->capture_default_str();
  CLI::Option* length = app.add_option_function<std::string>(
      "--length", [&](const std::string& text) { source.length_m = lengthOf(text); },
      "longest side of the real body, with its unit, e.g. 200mm; instead of --unit");
  length->excludes(unit);
  app.add_option("--scale", source.scale, "metres for one unit of the mesh; instead of --unit")
      ->check(CLI::PositiveNumber)
      ->excludes(unit)
      ->excludes(length);
  app.add_option("--thickness", source.thickness,
                 "thickness of a sheet, for a mesh that encloses no volume [unit of the mesh]")
      ->check(CLI::PositiveNumber);
  app.add_option("--cage-vertices", settings.cage_vertices,
                 "approximate number of cage vertices; default: chosen from the shape")
      ->check(CLI::Range(20, 20000));
  return softbody::runTool(&app, argc, argv, [&] {
    softbody::prepareModel(source, output, settings, std::cerr);
    return 0;
  });
}
