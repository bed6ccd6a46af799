#include "softbody_scanning/tools/scan_model.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "softbody_common/camera_options.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/run_tool.h"
#include "softbody_scanning/motion/sheet_motion.h"
#include "softbody_scanning/ros/recorded_frames.h"
#include "softbody_scanning/scan/scanned_body.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/report/model_folder.h"

namespace softbody::scanning {
namespace {

struct Arguments {
  std::vector<std::string> recordings;
  std::string output, sheet;
  CameraTopics camera = "/camera";
  ScanSettings settings;
};

Eigen::AlignedBox3d regionOf(const ToolDescription& sheet) {
  Eigen::AlignedBox3d region;
  for (const ToolMarker& marker : sheet.markers) {
    const auto corners = markerCorners(marker);
    for (int k = 0; k < 4; ++k) region.extend(Eigen::Vector3d(corners.col(k)));
  }
  region.min().z() = -0.01;
  region.max().z() = region.sizes().head<2>().maxCoeff() + 0.1;
  return region;
}

void scan(Arguments arguments) {
  const ToolDescription sheet = loadToolDescription(arguments.sheet);
  SheetMotion motion(sheet);
  const RecordedFrames recorded =
      readFrames(arguments.recordings.front(), arguments.camera, &motion, ProgressLine("scan_model"));
  fmt::print("{} of {} frames posed, {} key frames\n", recorded.posed, recorded.frames,
             recorded.key_frames.size());
  const auto start = std::chrono::steady_clock::now();
  arguments.settings.progress = [&](const std::string& step) {
    fmt::print("{:6.1f} s {}\n",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), step);
  };
  const ScannedBody body =
      scanBody({{arguments.recordings.front(), recorded.key_frames, regionOf(sheet)}}, arguments.settings);
  fmt::print("{} vertices, voxel {:.2f} mm, depth sigma {:.2f} mm\n", body.mesh.vertices.rows(),
             1e3 * body.voxel_m, 1e3 * body.depth_std_m);
  const StagedFolder staging(arguments.output);
  const std::string mesh = (staging.path() / "scan.obj").string();
  writeObj(mesh, body.mesh);
  prepareModel({mesh}, arguments.output, {0, false}, std::cerr);
}

}  // namespace

int runScanModel(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Makes the model of an object from a recording of it: an object folder as prepare_model's");
  app.add_option("recording", arguments.recordings, "bag with the camera's topics")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--output", arguments.output, "folder to write")->required();
  app.add_option("--sheet", arguments.sheet, "tool YAML of the sheet below the object")
      ->check(CLI::ExistingFile);
  addCameraOptions(&app, &arguments.camera);
  return runTool(&app, argc, argv, [&] {
    scan(arguments);
    return 0;
  });
}

}  // namespace softbody::scanning
