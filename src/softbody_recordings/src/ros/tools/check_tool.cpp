#include "softbody_recordings/tools/check_tool.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_tracking/tool/tool_calibration_check.h"

namespace softbody {

int runCheckTool(int argc, char** argv) {
  std::string input, tool;
  FileScope scope = FileScope::kOwnFolder;
  BagFramesConfig config;
  CLI::App app(
      "Checks whether a tool YAML fits a recording of the tool. Exit code 0: it fits; 1: it does not");
  app.add_option("input", input, "bag with the camera's topics, in which the tool is visible")
      ->required()
      ->check(CLI::ExistingFile | CLI::ExistingDirectory);
  app.add_option("--tool", tool, "tool YAML")->required()->check(CLI::ExistingFile);
  addCameraOptions(&app, &config.camera);
  addAllowOutside(&app, &scope);
  return runTool(&app, argc, argv, [&] {
    const ToolDescription description = loadToolWithMarkers(tool, scope);
    for (const std::string& warning : description.warnings) fmt::print(stderr, "check_tool: {}\n", warning);
    ToolCalibrationCheck check(description);
    const rosbag::Bag bag = openBag(input);
    CameraIngest ingest{CameraIngestConfig()};
    ProgressLine progress("check_tool");
    readBagFrames(bag, config, &ingest, [&](const auto& frame, const auto&, double share) {
      check.add(frame);
      progress(share);
    });
    const ToolCalibrationReport report = check.report();
    fmt::print("frames {}, tool seen {}\nreprojection {:.2f} px\nnoise {:.2f} mm\n", report.frames,
               report.seen, report.reprojection_px, 1e3 * report.noise_m);
    if (report.depth_ratio > 0.0) fmt::print("measured / computed depth {:.3f}\n", report.depth_ratio);
    for (const std::string& fault : report.faults) fmt::print("wrong: {}\n", fault);
    return report.faults.empty() ? 0 : 1;
  });
}

}  // namespace softbody
