#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <opencv2/core/utility.hpp>

#include "softbody_bringup/bag_frames.h"
#include "softbody_bringup/cut_journal.h"
#include "softbody_bringup/graph_config.h"
#include "softbody_bringup/pipeline.h"
#include "softbody_bringup/result_bag.h"
#include "softbody_common/tracking_state.h"

namespace {

struct Options {
  std::string input, object, output, parameters, tool, journal;
  std::string camera = "/camera", topic_namespace = "/softbody", body_frame = "softbody", simd;
  bool timing = false;
};

/// What the summary counts.
struct Tally {
  int states = 0;
  int tools = 0;
  int cuts = 0;
  std::map<softbody::TrackingState, int> by_state;
  std::map<softbody::TrackingState, std::string> reasons;  ///< the last one of each state
  double milliseconds = 0.0;
};

/// On a terminal only: in a log it would be a hundred lines.
void showProgress(double share) {
  static int shown = -1;
  const int percent = static_cast<int>(100.0 * share);
  if (percent == shown || isatty(STDERR_FILENO) == 0) return;
  shown = percent;
  fmt::print(stderr, "\rreplay: {:3d} %", percent);
}

rosbag::Bag openBag(const std::string& path) try {
  return rosbag::Bag(path, rosbag::bagmode::Read);
} catch (const rosbag::BagException& error) {
  throw std::invalid_argument(
      fmt::format("{} is not a readable bag: {} (try: rosbag check, rosbag reindex)", path, error.what()));
}

void printSummary(const softbody::BagFramesReport& report, const Tally& tally, const std::string& output) {
  using softbody::TrackingState;
  const auto count = [&tally](TrackingState state) {
    const auto found = tally.by_state.find(state);
    return found == tally.by_state.end() ? 0 : found->second;
  };
  fmt::print("frames {}, with a surface {}, without depth {}, unusable {}\n", report.frames, tally.states,
             report.without_depth, report.unusable);
  fmt::print("tracking {}, degraded {}, lost {}, recovering {}, initializing {}\n",
             count(TrackingState::kTracking), count(TrackingState::kDegraded), count(TrackingState::kLost),
             count(TrackingState::kRecovering), count(TrackingState::kInitializing));
  for (const auto& [state, reason] : tally.reasons) {
    if (!reason.empty()) fmt::print("{}: {}\n", nameOf(state), reason);
  }
  if (report.unusable > 0) fmt::print("last unusable frame: {}\n", report.last_error);
  fmt::print(stderr, "replay: {:.1f} ms a frame; wrote {}\n", tally.milliseconds / std::max(1, report.frames),
             output);
}

void replay(const Options& options) {
  std::vector<std::string> warnings;
  softbody::GraphConfig config = softbody::readGraphConfig(options.parameters, &warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "replay: {}\n", warning);
  if (!options.simd.empty()) config.pipeline.simulator.simd = options.simd;
  const softbody::ObjectDescription description = softbody::loadObjectDescription(options.object);
  const softbody::ObjectModel model = softbody::buildObjectModel(description);
  if (!description.pins.empty())
    fmt::print(stderr, "replay: {}: its pins hold nothing here, where there is no tf\n", options.object);
  for (const std::string& warning : model.warnings)
    fmt::print(stderr, "replay: {}: {}\n", options.object, warning);
  const rosbag::Bag input = openBag(options.input);
  std::optional<softbody::ToolDescription> tool;
  if (!options.tool.empty()) {
    tool = softbody::loadToolDescription(options.tool);
    for (const std::string& warning : tool->warnings) fmt::print(stderr, "replay: {}\n", warning);
  }
  softbody::CutJournal journal;
  if (!options.journal.empty())
    journal = softbody::CutJournal(openBag(options.journal), options.topic_namespace + "/cut");
  softbody::Pipeline pipeline(model, config.pipeline, tool);
  softbody::CameraIngest ingest(config.ingest);
  softbody::ResultBag output(options.output, options.topic_namespace, options.body_frame, options.timing);
  if (tool) output.setBlade(tool->blade);

  Tally tally;
  ros::Time topologies_written;
  const auto use = [&](const softbody::RgbdFrame& frame, const std_msgs::Header& header, double progress) {
    const auto start = std::chrono::steady_clock::now();
    const softbody::FrameOutput result = pipeline.process(frame, journal.takeUntil(frame.stamp));
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    tally.milliseconds += elapsed.count();
    tally.states += result.surface ? 1 : 0;
    tally.tools += result.tool ? 1 : 0;
    tally.cuts += static_cast<int>(result.cuts.size());
    for (const std::string& refusal : result.refusals)
      fmt::print(stderr, "replay: a cut of the journal is not made: {}\n", refusal);
    ++tally.by_state[result.tracking.status.state];
    tally.reasons[result.tracking.status.state] = result.tracking.status.reason;
    const bool due =
        header.stamp < topologies_written || header.stamp - topologies_written >= ros::Duration(1.0);
    if (topologies_written.isZero() || due || !result.cuts.empty()) {
      output.writeTopologies(pipeline, header.stamp);
      topologies_written = header.stamp;
    }
    output.writeFrame(result, header);
    showProgress(progress);
  };
  softbody::BagFramesConfig frames;
  frames.camera = options.camera;
  frames.sync_tolerance = config.sync_tolerance;
  const softbody::BagFramesReport report = softbody::readBagFrames(input, frames, &ingest, use);
  if (tally.by_state.empty()) {
    throw std::runtime_error(fmt::format("{} holds no usable frame{}{}", options.input,
                                         report.last_error.empty() ? "" : ": ", report.last_error));
  }
  if (tally.states == 0) {
    throw std::runtime_error(
        fmt::format("no frame of {} gave a surface: {}", options.input, tally.reasons.begin()->second));
  }
  output.finish();
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\n");
  printSummary(report, tally, options.output);
  if (tool || !options.journal.empty()) {
    const std::vector<std::uint32_t>& bodies = pipeline.surfaceTopology().bodies;
    fmt::print("frames with the tool {}, cuts {}, pieces {}\n", tally.tools, tally.cuts,
               bodies.empty() ? 0 : 1 + *std::max_element(bodies.begin(), bodies.end()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Runs the graph's cores over a bag without a master: every frame, in order, as fast as it goes");
  app.add_option("input", options.input, "bag with the camera topics")->required()->check(CLI::ExistingFile);
  app.add_option("--object", options.object, "object YAML")->required()->check(CLI::ExistingFile);
  app.add_option("--output", options.output, "bag to write")->required();
  app.add_option("--parameters", options.parameters, "YAML with a section of parameters for each node")
      ->check(CLI::ExistingFile);
  CLI::Option* tool = app.add_option("--tool", options.tool, "tool YAML: a tool that is tracked, and cuts")
                          ->check(CLI::ExistingFile);
  app.add_option("--journal", options.journal, "bag with cuts, which are made again instead of a tool's")
      ->check(CLI::ExistingFile)
      ->excludes(tool);
  app.add_option("--camera", options.camera, "namespace of the camera topics")->capture_default_str();
  app.add_option("--namespace", options.topic_namespace, "namespace of the output topics")
      ->capture_default_str();
  app.add_option("--simd", options.simd, "vector instructions of the simulator, whatever the parameters say")
      ->check(CLI::IsMember({"auto", "sse4", "avx2", "avx512"}));
  app.add_flag("--timing", options.timing,
               "write wall-clock stage times too (then the output differs from run to run)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (std::filesystem::exists(options.output) && std::filesystem::equivalent(options.input, options.output)) {
    fmt::print(stderr, "replay: --output is the input {}; name another file\n", options.input);
    return 2;
  }
  // One thread: the order of floating-point sums must not depend on scheduling.
  cv::setNumThreads(1);
  try {
    replay(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "replay: {}\n", error.what());
    return 1;
  }
  return 0;
}
