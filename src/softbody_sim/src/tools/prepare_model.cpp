#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "cage/fill_request.h"
#include "report/model_folder.h"
#include "softbody_common/run_tool.h"
#include "tools/surface_filling.h"

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
  app.add_option("--unit", source.unit, "unit of the mesh")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
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
