#include "softbody_recordings/tools/replay.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/ros/replay.h"

namespace softbody {
namespace {

void declareGripper(CLI::App* app, ReplayOptions* options) {
  app->add_option("--gripper", options->gripper,
                  "YAML of a gripper, or the frame between its fingers, in the bag's tf: what it grips is "
                  "held; replaces the parameter");
}

void declareInput(CLI::App* app, ReplayOptions* options) {
  app->add_option("input", options->input, "bag with the camera topics")
      ->required()
      ->check(CLI::ExistingFile | CLI::ExistingDirectory);
  app->add_option("--object", options->objects,
                  "object YAML, or its folder; give it again for each further body: each has its own topics, "
                  "named as its file")
      ->required()
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingPath);
  app->add_option("--parameters", options->parameters, "YAML with a section of parameters for each node")
      ->check(CLI::ExistingFile);
  CLI::Option* tool =
      app->add_option("--tool", options->tool,
                      "tool YAML: the tool is tracked, and its blade cuts the bodies that it meets")
          ->check(CLI::ExistingFile);
  app->add_option("--blade-frame", options->blade_frame,
                  "frame in the bag's tf that carries the tool, in place of its markers; replaces the "
                  "parameter")
      ->needs(tool);
  app->add_option("--journal", options->journal, "bag with cuts to repeat, instead of a tool")
      ->check(CLI::ExistingFile)
      ->excludes(tool);
  app->add_option("--known-surfaces", options->known_surfaces,
                  "surfaces that the bag also has, e.g. /doll/surface: they are not taken for the body")
      ->delimiter(',');
  app->add_option("--robot", options->robot,
                  "URDF: the robot's links, where the bag's tf says they are, are not taken for the body")
      ->check(CLI::ExistingFile);
  declareGripper(app, options);
  addCameraOptions(app, &options->camera);
  addAllowOutside(app, &options->scope);
}

void declareOutput(CLI::App* app, ReplayOptions* options) {
  app->add_option("--output", options->output, "bag to write")->required();
  app->add_option("--namespace", options->topic_namespace, "namespace of the output topics of one body")
      ->capture_default_str();
  app->add_option(
      "--output-frame", options->output_frame,
      "frame of targets and states, connected by the bag's tf; give a fixed frame if the camera moves; "
      "default: the frame of the parameters, or else the colour optical frame");
  app->add_option("--simd", options->simd, "vector instructions of the simulator; replaces the parameter")
      ->check(CLI::IsMember({"auto", "sse4", "avx2", "avx512"}));
  app->add_flag("--timing", options->timing,
                "also write wall-clock times of the stages; the output then differs between runs");
  app->add_flag("--labels", options->labels,
                "also write the label of each pixel: background, body or occluder");
  app->add_flag("--forces", options->forces, "also write the external forces on the body; takes longer");
  app->add_option("--open-loop", options->open_loop,
                  "last share of the images that is not used: the simulation goes on with pins, gripper and "
                  "obstacles alone; evaluate --open-loop measures it")
      ->check(CLI::Range(0.0, 0.95));
  app->add_flag("--placed", options->placed,
                "take the object's initial_pose as it is, without a search: shows how the tracker judges a "
                "pose or mesh");
  app->callback([options] { requireOtherFile(options->input, options->output); });
}

int countOf(const BodySummary& summary, TrackingState state) {
  const auto found = summary.frames_by_state.find(state);
  return found == summary.frames_by_state.end() ? 0 : found->second;
}

void printLeftOut(const BagFramesReport& read) {
  const UnpairedImages& unpaired = read.unpaired;
  const std::pair<int, const char*> kinds[] = {
      {read.undecoded, "compressed images that cannot be decoded"},
      {unpaired.unstamped, "images without a stamp"},
      {unpaired.outliers, "images with an odd stamp, far from those before and after"},
      {unpaired.colors_repeated, "colour images with the stamp of the image before"},
      {unpaired.depths_repeated, "depth images with the stamp of the image before"},
      {unpaired.colors_late, "colour images that arrived after a later one"},
      {unpaired.depths_late, "depth images that arrived after a later one"},
      {unpaired.colors_alone, "colour images without a depth image"},
      {unpaired.depths_alone, "depth images without a colour image"}};
  for (const auto& [images, kind] : kinds)
    if (images > 0) fmt::print("left out: {} {}\n", images, kind);
}

void printStates(const BodySummary& body) {
  fmt::print("tracking {}, degraded {}, lost {}, recovering {}, initializing {}\n",
             countOf(body, TrackingState::kTracking), countOf(body, TrackingState::kDegraded),
             countOf(body, TrackingState::kLost), countOf(body, TrackingState::kRecovering),
             countOf(body, TrackingState::kInitializing));
  for (const auto& [state, reason] : body.reasons) {
    if (!reason.empty()) fmt::print("{}: {}\n", nameOf(state), reason);
  }
}

void print(const BagFramesReport& read, const BodySummary& body, bool with_cuts) {
  fmt::print("frames {}, with a surface {}, without depth {}, unusable {}, skipped {}\n", read.frames,
             body.states, read.without_depth, read.unusable + body.failed, body.skipped);
  if (body.predicted > 0) fmt::print("predicted without images: the last {} frames\n", body.predicted);
  printLeftOut(read);
  printStates(body);
  if (!read.last_error.empty()) fmt::print("last unusable frame: {}\n", read.last_error);
  if (with_cuts)
    fmt::print("frames with the tool {}, cuts {}, pieces {}\n", body.tools, body.cuts, body.pieces);
  if (!body.tool_missed.empty()) fmt::print("no usable pose of the tool in {}\n", body.tool_missed);
}

void print(const ReplaySummary& summary, const ReplayOptions& options) {
  double milliseconds = 0.0;
  for (const BodySummary& body : summary.bodies) {
    if (summary.bodies.size() > 1) fmt::print("{}\n", body.topic_namespace);
    print(summary.read, body, !options.tool.empty() || !options.journal.empty());
    milliseconds += body.milliseconds;
  }
  fmt::print(stderr, "replay: {:.1f} ms a frame; wrote {}\n", milliseconds / std::max(1, summary.read.frames),
             options.output);
}

}  // namespace

int runReplay(int argc, char** argv) {
  ReplayOptions options;
  CLI::App app(
      "Runs the graph's cores over a bag without a ROS master: every frame, in order, as fast as possible");
  declareInput(&app, &options);
  declareOutput(&app, &options);
  return runTool(&app, argc, argv, [&] {
    // One thread: the order of floating-point sums must not depend on scheduling.
    cv::setNumThreads(1);
    const auto warn = [](const std::string& sentence) { fmt::print(stderr, "replay: {}\n", sentence); };
    print(replay(options, warn, ProgressLine("replay")), options);
    return 0;
  });
}

}  // namespace softbody
