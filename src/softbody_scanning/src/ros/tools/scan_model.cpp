#include "softbody_scanning/tools/scan_model.h"

#include <fmt/format.h>
#include <ros/package.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "softbody_common/camera_options.h"
#include "softbody_common/run_tool.h"
#include "softbody_scanning/output/scanned_model.h"
#include "softbody_scanning/ros/recording_reader.h"
#include "softbody_scanning/scan/checked_scan.h"

namespace softbody::scanning {
namespace {

constexpr int kBadVerdict = 3;  ///< exit code, as prepare_model's

struct Arguments {
  std::vector<std::string> recordings;
  std::string output, sheet;
  CameraTopics camera = "/camera";
  double voxel_mm = 0.0;
  MotionSource motion = MotionSource::kAuto;
  std::string fixed_frame;
};

void declare(CLI::App* app, Arguments* arguments) {
  app->add_option(
         "recording", arguments->recordings,
         "bag with the camera's topics: the camera moves once round the object. Further bags show the object "
         "turned over")
      ->required()
      ->check(CLI::ExistingFile);
  app->add_option("--output", arguments->output, "folder to write")->required();
  app->add_option("--sheet", arguments->sheet,
                  "YAML of the printed sheet below the object, from make_board --sheet; default: the shipped "
                  "sheet.yaml, "
                  "on A4")
      ->check(CLI::ExistingFile);
  const std::map<std::string, MotionSource> sources = {{"auto", MotionSource::kAuto},
                                                       {"sheet", MotionSource::kSheet},
                                                       {"tf", MotionSource::kTransforms},
                                                       {"none", MotionSource::kNone}};
  app->add_option("--motion", arguments->motion,
                  "where the camera's motion is from: sheet; tf; none (from images and depth alone); auto: "
                  "the first of "
                  "these that the recording has")
      ->transform(CLI::CheckedTransformer(sources))
      ->default_str("auto");
  app->add_option("--fixed-frame", arguments->fixed_frame,
                  "frame of /tf in which the object rests; default: the one above all others");
  app->add_option("--voxel-mm", arguments->voxel_mm,
                  "fineness of the model [mm]; default: 1, or 1/200 of its size")
      ->check(CLI::Range(0.3, 20.0));
  addCameraOptions(app, &arguments->camera);
}

/// What was found out about a recording, in a line.
std::string lineOf(const std::string& bag, const RecordingReport& report) {
  std::string line = fmt::format("{}: camera motion: {}; {} of {} frames, {} key frames", bag,
                                 nameOf(report.motion), report.posed, report.frames, report.key_frames);
  if (report.position_std_m > 0.0) line += fmt::format("; sure to {:.2f} mm", 1e3 * report.position_std_m);
  if (report.depth_scale > 0.0)
    line += fmt::format("; depth is {:+.2f} % off the sheet's", 1e2 * (report.depth_scale - 1.0));
  return line + "\n";
}

int scan(const Arguments& arguments) {
  RecordingOptions options;
  options.camera = arguments.camera;
  options.motion = arguments.motion;
  options.fixed_frame = arguments.fixed_frame;
  options.sheet = loadToolDescription(arguments.sheet);
  std::vector<PosedRecording> recordings;
  std::string report;
  for (const std::string& bag : arguments.recordings) {
    options.bag = bag;
    RecordingReport found;
    fmt::print(stderr, "scan_model: read {}\n", bag);
    recordings.push_back(readRecording(options, ProgressLine("scan_model"), &found));
    report += lineOf(bag, found);
    fmt::print("{}", lineOf(bag, found));
    std::fflush(stdout);
  }
  ScanSettings settings;
  settings.voxel_m = 1e-3 * arguments.voxel_mm;
  settings.progress = [](const std::string& step) { fmt::print(stderr, "scan_model: {}\n", step); };
  CheckedScan scan = scanAndCheck(std::move(recordings), settings);
  report += reportOf(scan);
  fmt::print("{}", reportOf(scan));
  fmt::print(stderr, "scan_model: prepare the model\n");
  const Verdict verdict =
      writeModel(std::move(scan), report, arguments.output, ProgressLine("scan_model"), std::cout);
  return verdict == Verdict::kBad ? kBadVerdict : 0;
}

}  // namespace

int runScanModel(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Makes the model of an object from a recording of it: an object folder as prepare_model's");
  arguments.sheet = ros::package::getPath("softbody_bringup") + "/config/sheet.yaml";
  declare(&app, &arguments);
  app.footer(
      "Exit codes: 0 done; 1 no model can be made of it; 2 wrong usage; 3 done, but the model's verdict is "
      "bad.");
  return runTool(&app, argc, argv, [&] { return scan(arguments); });
}

}  // namespace softbody::scanning
