#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "cage/fill_request.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_sim/report/model_folder.h"
#include "tools/surface_filling.h"

namespace {

constexpr int kBadVerdict = 3;  ///< exit code: the folder is written, but the model will not work

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

CLI::Range rangeOf(const softbody::AllowedCount& allowed) { return CLI::Range(allowed.least, allowed.most); }

/// Size, kind and choice of the body.
void addBodyOptions(CLI::App* app, softbody::ModelSource* source) {
  CLI::Option* unit = app->add_option("--unit", source->unit, "unit of the mesh")
                          ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
                          ->capture_default_str();
  CLI::Option* length = app->add_option_function<std::string>(
      "--length", [source](const std::string& text) { source->body.length_m = lengthOf(text); },
      "longest side of the real body, with its unit, e.g. 200mm; instead of --unit");
  length->excludes(unit);
  app->add_option("--scale", source->scale, "metres for one unit of the mesh; instead of --unit")
      ->check(CLI::PositiveNumber)
      ->excludes(unit)
      ->excludes(length);
  app->add_option("--thickness", source->body.thickness,
                  "thickness of a sheet, for a mesh that encloses no volume [unit of the mesh]")
      ->check(CLI::PositiveNumber);
  app->add_option("--shell", source->body.shell,
                  "which body of a file with several: a number of the list, largest or all; default: the "
                  "largest if the "
                  "others are below 5 % of the volume")
      ->check(CLI::IsMember({"largest", "all"}) | rangeOf(softbody::kShellNumbers));
  app->add_option("--simplify", source->body.triangles,
                  "reduce the visual mesh to about this number of triangles")
      ->check(rangeOf(softbody::kTriangleCounts));
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
  addBodyOptions(&app, &source);
  app.add_option("--cage-vertices", settings.cage_vertices,
                 "approximate number of cage vertices; default: chosen from the shape")
      ->check(rangeOf(softbody::kCageVertexCounts));
  app.footer(
      "Exit codes: 0 done; 1 the mesh could not be processed; 2 wrong usage; 3 done, but the verdict is "
      "bad.");
  return softbody::runTool(&app, argc, argv, [&] {
    const softbody::Verdict verdict = softbody::prepareModel(source, output, settings, std::cerr);
    return verdict == softbody::Verdict::kBad ? kBadVerdict : 0;
  });
}
