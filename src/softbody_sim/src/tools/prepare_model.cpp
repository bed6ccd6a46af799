#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "report/model_folder.h"
#include "softbody_common/run_tool.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Makes a ready object folder of a surface mesh: visual mesh, cage, tet mesh, object.yaml and a "
      "report."};
  std::string mesh, output, unit = "m";
  softbody::VolumeSettings settings;
  settings.use_cache = false;
  settings.progress = softbody::ProgressLine("prepare_model");
  app.add_option("MESH", mesh, "OBJ, PLY, STL or OFF")->required();
  app.add_option("--output", output, "folder to write")->required();
  app.add_option("--unit", unit, "unit of the mesh")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  app.add_option("--cage-vertices", settings.cage_vertices,
                 "about as many vertices has the cage; without it, as many as suit its shape")
      ->check(CLI::Range(20, 20000));
  return softbody::runTool(&app, argc, argv, [&] {
    softbody::prepareModel(mesh, unit, output, settings, std::cerr);
    return 0;
  });
}
