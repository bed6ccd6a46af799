#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "report/model_folder.h"
#include "softbody_common/run_tool.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Makes an object folder from a surface mesh: visual mesh, cage, tet mesh, object.yaml and report."};
  std::string mesh, output, unit = "m";
  softbody::VolumeSettings settings;
  settings.use_cache = false;
  settings.progress = softbody::ProgressLine("prepare_model");
  app.add_option("MESH", mesh, "OBJ, PLY, STL or OFF")->required();
  app.add_option("--output", output, "output folder")->required();
  app.add_option("--unit", unit, "unit of the mesh")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  app.add_option("--cage-vertices", settings.cage_vertices,
                 "approximate number of cage vertices; default: chosen from the shape")
      ->check(CLI::Range(20, 20000));
  return softbody::runTool(&app, argc, argv, [&] {
    softbody::prepareModel(mesh, unit, output, settings, std::cerr);
    return 0;
  });
}
