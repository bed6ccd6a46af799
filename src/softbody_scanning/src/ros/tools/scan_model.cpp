#include "softbody_scanning/tools/scan_model.h"

#include <fmt/format.h>
#include <ros/package.h>

#include <CLI/CLI.hpp>
#include <array>
#include <iostream>
#include <map>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
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
  std::vector<std::array<double, 3>> at;
  std::vector<std::array<double, 4>> boxes;
};

/// Which of the things on the table is the object.
void declareChoice(CLI::App* app, Arguments* arguments) {
  app->add_option(
         "--at", arguments->at,
         "a point on the object [m], in the sheet's frame: origin in its middle, x to the right and y up "
         "as printed, z towards the viewer; without a sheet in the frame of the places that the report "
         "names. Give it once for all recordings, or once for each. Default: what is large and near to the "
         "middle")
      ->type_name("X Y Z")
      ->allow_extra_args(false);
  app->add_option(
         "--box", arguments->boxes,
         "rectangle on the table [m], in the frame of --at: only what stands in it is looked at. Once for "
         "all recordings, or once for each. Default: the sheet and a quarter of its size on each side")
      ->type_name("X0 Y0 X1 Y1")
      ->allow_extra_args(false);
}

/// @throw CLI::ValidationError
void requireOneForEach(const Arguments& arguments) {
  const auto require = [&](const char* option, std::size_t count) {
    if (count > 1 && count != arguments.recordings.size())
      throw CLI::ValidationError(
          option, fmt::format("is given {} times for {} recordings; give it once for all, or once for each",
                              count, arguments.recordings.size()));
  };
  require("--at", arguments.at.size());
  require("--box", arguments.boxes.size());
  for (const auto& at : arguments.at)
    if (!isPlausible(Eigen::Vector3d(at.data())))
      throw CLI::ValidationError("--at",
                                 fmt::format("{} {} {} is no place on a table [m]", at[0], at[1], at[2]));
  for (const auto& [x0, y0, x1, y1] : arguments.boxes)
    if (!(x0 < x1 && y0 < y1))
      throw CLI::ValidationError(
          "--box",
          fmt::format("{} {} {} {} is empty: X0 must be less than X1, and Y0 less than Y1", x0, y0, x1, y1));
}

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
  declareChoice(app, arguments);
  addCameraOptions(app, &arguments->camera);
  app->callback([arguments] { requireOneForEach(*arguments); });
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

/// Applies --at and --box to the recording with number i.
/// @throw std::invalid_argument if they cannot be meant for it.
void choose(const Arguments& arguments, std::size_t i, MotionSource motion, PosedRecording* recording) {
  const auto of_this = [&](const auto& values) {
    if (values.size() < arguments.recordings.size() && motion != MotionSource::kSheet)
      throw std::invalid_argument(
          recording->name +
          ": without a sheet each recording has its own frame; give --at or --box once "
          "for each recording");
    return values[values.size() == 1 ? 0 : i];
  };
  if (!arguments.at.empty()) recording->at = Eigen::Vector3d(of_this(arguments.at).data());
  if (arguments.boxes.empty()) return;
  const auto [x0, y0, x1, y1] = of_this(arguments.boxes);
  const Eigen::AlignedBox3d known = recording->region;
  const Eigen::AlignedBox3d box(Eigen::Vector3d(x0, y0, known.min().z()),
                                Eigen::Vector3d(x1, y1, known.max().z()));
  recording->region = known.intersection(box);
  if (recording->region.isEmpty())
    throw std::invalid_argument(fmt::format(
        "{}: --box {} {} {} {} lies beside the recorded space, {:.2f} {:.2f} {:.2f} {:.2f} m; give metres",
        recording->name, x0, y0, x1, y1, known.min().x(), known.min().y(), known.max().x(), known.max().y()));
}

int scan(const Arguments& arguments) {
  RecordingOptions options;
  options.camera = arguments.camera;
  options.motion = arguments.motion;
  options.fixed_frame = arguments.fixed_frame;
  options.sheet = loadToolWithMarkers(arguments.sheet);
  std::vector<PosedRecording> recordings;
  std::string report;
  for (const std::string& bag : arguments.recordings) {
    options.bag = bag;
    RecordingReport found;
    fmt::print(stderr, "scan_model: read {}\n", bag);
    recordings.push_back(readRecording(options, ProgressLine("scan_model"), &found));
    choose(arguments, recordings.size() - 1, found.motion, &recordings.back());
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
