#include "softbody_recordings/ros/replay.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "softbody_common/run_tool.h"
#include "softbody_common/tracking_state.h"

namespace {

using softbody::ReplayOptions;
using softbody::ReplaySummary;
using softbody::TrackingState;

void declare(CLI::App* app, ReplayOptions* options) {
  app->add_option("input", options->input, "bag with the camera topics")
      ->required()
      ->check(CLI::ExistingFile);
  app->add_option("--object", options->object, "object YAML")->required()->check(CLI::ExistingFile);
  app->add_option("--output", options->output, "bag to write")->required();
  app->add_option("--parameters", options->parameters, "YAML with a section of parameters for each node")
      ->check(CLI::ExistingFile);
  CLI::Option* tool = app->add_option("--tool", options->tool, "tool YAML: a tool that is tracked, and cuts")
                          ->check(CLI::ExistingFile);
  app->add_option("--journal", options->journal, "bag with cuts, which are made again instead of a tool's")
      ->check(CLI::ExistingFile)
      ->excludes(tool);
  app->add_option("--camera", options->camera, "namespace of the camera topics")->capture_default_str();
  app->add_option("--namespace", options->topic_namespace, "namespace of the output topics")
      ->capture_default_str();
  app->add_option(
      "--output-frame", options->output_frame,
      "frame of targets and states by the bag's tf, one that stands still for a camera that moves; "
      "default: as the parameters say, or else the colour optical frame");
  app->add_option("--simd", options->simd,
                  "vector instructions of the simulator, whatever the parameters say")
      ->check(CLI::IsMember({"auto", "sse4", "avx2", "avx512"}));
  app->add_flag("--timing", options->timing,
                "write wall-clock stage times too (then the output differs from run to run)");
  app->callback([options] { softbody::requireOtherFile(options->input, options->output); });
}

void print(const ReplaySummary& summary, const ReplayOptions& options) {
  const auto count = [&summary](TrackingState state) {
    const auto found = summary.frames_by_state.find(state);
    return found == summary.frames_by_state.end() ? 0 : found->second;
  };
  fmt::print("frames {}, with a surface {}, without depth {}, unusable {}, skipped {}\n", summary.read.frames,
             summary.states, summary.read.without_depth, summary.read.unusable, summary.skipped);
  const softbody::UnpairedImages& left_out = summary.read.unpaired;
  const std::pair<int, const char*> kinds[] = {
      {left_out.unstamped, "images without a stamp"},
      {left_out.colors_repeated, "colour images with the stamp of the image before"},
      {left_out.depths_repeated, "depth images with the stamp of the image before"},
      {left_out.colors_late, "colour images that arrived after a later one"},
      {left_out.depths_late, "depth images that arrived after a later one"},
      {left_out.colors_alone, "colour images without a depth image"},
      {left_out.depths_alone, "depth images without a colour image"}};
  for (const auto& [images, kind] : kinds)
    if (images > 0) fmt::print("left out: {} {}\n", images, kind);
  fmt::print("tracking {}, degraded {}, lost {}, recovering {}, initializing {}\n",
             count(TrackingState::kTracking), count(TrackingState::kDegraded), count(TrackingState::kLost),
             count(TrackingState::kRecovering), count(TrackingState::kInitializing));
  for (const auto& [state, reason] : summary.reasons) {
    if (!reason.empty()) fmt::print("{}: {}\n", nameOf(state), reason);
  }
  if (summary.read.unusable > 0) fmt::print("last unusable frame: {}\n", summary.read.last_error);
  if (!options.tool.empty() || !options.journal.empty())
    fmt::print("frames with the tool {}, cuts {}, pieces {}\n", summary.tools, summary.cuts, summary.pieces);
  if (!summary.tool_missed.empty()) fmt::print("tool not seen in {}\n", summary.tool_missed);
  fmt::print(stderr, "replay: {:.1f} ms a frame; wrote {}\n",
             summary.milliseconds / std::max(1, summary.read.frames), options.output);
}

}  // namespace

int main(int argc, char** argv) {
  ReplayOptions options;
  CLI::App app(
      "Runs the graph's cores over a bag without a master: every frame, in order, as fast as it goes");
  declare(&app, &options);
  return softbody::runTool(&app, argc, argv, [&] {
    // One thread: the order of floating-point sums must not depend on scheduling.
    cv::setNumThreads(1);
    const auto warn = [](const std::string& sentence) { fmt::print(stderr, "replay: {}\n", sentence); };
    print(replay(options, warn, softbody::ProgressLine("replay")), options);
    return 0;
  });
}
