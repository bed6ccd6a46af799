#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "softbody_common/run_tool.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_tracking/tool/tool_calibration_check.h"

int main(int argc, char** argv) {
  std::string input, tool;
  softbody::BagFramesConfig config;
  CLI::App app("Says whether a tool YAML fits a recording of the tool and its camera; 0: it does, 1: not");
  app.add_option("input", input, "bag with the camera's topics, the tool in view")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--tool", tool, "tool YAML")->required()->check(CLI::ExistingFile);
  app.add_option("--camera", config.camera, "namespace of the camera's topics")->capture_default_str();
  return softbody::runTool(&app, argc, argv, [&] {
    const softbody::ToolDescription description = softbody::loadToolDescription(tool);
    for (const std::string& warning : description.warnings) fmt::print(stderr, "check_tool: {}\n", warning);
    softbody::ToolCalibrationCheck check(description);
    const rosbag::Bag bag = softbody::openBag(input);
    softbody::CameraIngest ingest{softbody::CameraIngestConfig()};
    softbody::ProgressLine progress("check_tool");
    softbody::readBagFrames(bag, config, &ingest, [&](const auto& frame, const auto&, double share) {
      check.add(frame);
      progress(share);
    });
    const softbody::ToolCalibrationReport report = check.report();
    fmt::print("frames {}, tool seen {}\nreprojection {:.2f} px\nnoise {:.2f} mm\n", report.frames,
               report.seen, report.reprojection_px, 1e3 * report.noise_m);
    if (report.depth_ratio > 0.0) fmt::print("measured / computed depth {:.3f}\n", report.depth_ratio);
    for (const std::string& fault : report.faults) fmt::print("wrong: {}\n", fault);
    return report.faults.empty() ? 0 : 1;
  });
}
