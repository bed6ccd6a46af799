#include "ros/replay/body_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/tool/marker_absence.h"

namespace softbody {
namespace {

constexpr double kTopologyPeriod_s = 1.0;  // as the nodes

}  // namespace

BodyRun::BodyRun(const ObjectModel& model, const PipelineConfig& config, BodyRunSetup setup,
                 AtomicBag* output, Warn warn)
    : warn_(std::move(warn)),
      output_frame_(std::move(setup.output_frame)),
      pipeline_(model, config, setup.tool),
      journal_(std::move(setup.journal)),
      surface_(setup.topic_namespace + "/surface"),
      output_(output, setup.topic_namespace, setup.extras) {
  summary_.topic_namespace = setup.topic_namespace;
  output_.setOutputFrame(output_frame_);
  if (setup.tool) output_.setBlade(setup.tool->blade);
}

void BodyRun::process(const RgbdFrame& frame, const std_msgs::Header& header,
                      const std::vector<KnownSurface>& others, const SurroundingsInput& surroundings) {
  run(frame, header, [&] {
    return pipeline_.process(withKnownSurfaces(frame, others), journal_.takeUntil(frame.stamp), surroundings);
  });
}

void BodyRun::predict(const RgbdFrame& frame, const std_msgs::Header& header,
                      const SurroundingsInput& surroundings) {
  run(frame, header, [&] { return pipeline_.predict(frame, journal_.takeUntil(frame.stamp), surroundings); });
}

void BodyRun::run(const RgbdFrame& frame, const std_msgs::Header& header, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  FrameOutput result;
  try {
    result = work();
  } catch (const std::exception& error) {
    return leaveOut(header, error.what());
  }
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  summary_.milliseconds += elapsed.count();
  if (!result.predicted) countTool(result.tool, header, frame);
  follow(result, frame);
  write(result, header);
}

std::optional<KnownSurface> BodyRun::surface(const RgbdFrame& frame) const {
  if (frame.pass != pass_) return std::nullopt;
  return surface_.at(frame.stamp, frame.T_fixed_camera.inverse());
}

void BodyRun::follow(const FrameOutput& result, const RgbdFrame& frame) {
  if (std::exchange(pass_, frame.pass) != frame.pass) surface_.forgetStates();
  if (!result.surface) return;
  if (!surface_.hasTopology(result.surface->revision)) surface_.setTopology(pipeline_.surfaceTopology());
  surface_.addState(*result.surface);
}

void BodyRun::skip(const RgbdFrame& frame, const std_msgs::Header& header, const std::string& why) {
  if (summary_.skipped++ == 0) warn_(fmt::format("frame at {:.3f} s skipped: {}", header.stamp.toSec(), why));
  count(skippedFrame(last_status_, header.frame_id, output_frame_, why));
  output_.writeStatus(last_status_, header);
  const std::optional<ToolObservation> tool = pipeline_.processUnplaced(frame);
  countTool(tool, header, frame);
  if (tool) output_.writeTool(*tool, header);
}

const BodySummary& BodyRun::finish() {
  const std::size_t left = journal_.size() + pipeline_.waitingCuts();
  if (left > 0)
    warn_(fmt::format("{} cuts of the journal were not made, because the body was not tracked after them",
                      left));
  const std::vector<std::uint32_t>& pieces = pipeline_.surfaceTopology().triangle_pieces;
  summary_.tool_missed = tool_dropouts_.missedFrames();
  if (!tool_dropouts_.cause().empty()) summary_.tool_missed += ". Probably " + tool_dropouts_.cause();
  summary_.pieces = pieces.empty() ? 0 : 1 + *std::max_element(pieces.begin(), pieces.end());
  return summary_;
}

void BodyRun::write(const FrameOutput& result, const std_msgs::Header& header) {
  for (const std::string& warning : result.warnings)
    warn_(fmt::format("at {:.3f} s {}", header.stamp.toSec(), warning));
  count(result);
  const double since_s = secondsBetween(topologies_written_, header.stamp);
  if (since_s < 0.0 || since_s >= kTopologyPeriod_s || !result.cuts.empty()) {
    output_.writeTopologies(pipeline_.volumeTopology(), pipeline_.surfaceTopology(), header.stamp);
    topologies_written_ = header.stamp;
  }
  output_.writeFrame(result, header);
}

void BodyRun::leaveOut(const std_msgs::Header& header, const std::string& why) {
  if (summary_.failed++ == 0) warn_(fmt::format("frame at {:.3f} s left out: {}", header.stamp.toSec(), why));
  last_status_.state = TrackingState::kDegraded;
  last_status_.reason = "frame left out: " + why;
  count(TrackingStatus(last_status_));
  output_.writeStatus(last_status_, header);
}

void BodyRun::countTool(const std::optional<ToolObservation>& tool, const std_msgs::Header& header,
                        const RgbdFrame& frame) {
  if (!pipeline_.toolTracker()) return;
  summary_.tools += tool && !tool->ambiguous ? 1 : 0;
  const auto missing = tool_dropouts_.update(
      toNanoseconds(header.stamp), tool, pipeline_.toolTracker()->reason(),
      [&] { return whyMarkersAreMissed(pipeline_.toolTracker()->tool(), frame.color); });
  if (missing) warn_(fmt::format("at {:.3f} s {}", header.stamp.toSec(), *missing));
}

void BodyRun::count(const TrackingStatus& status) {
  last_status_ = status;
  ++summary_.frames_by_state[status.state];
  summary_.reasons[status.state] = status.reason;
}

void BodyRun::count(const FrameOutput& result) {
  summary_.states += result.surface ? 1 : 0;
  summary_.cuts += static_cast<int>(result.cuts.size());
  if (result.predicted)
    summary_.predicted += result.surface ? 1 : 0;
  else
    count(result.tracking.status);
}

}  // namespace softbody
