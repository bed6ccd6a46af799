#include "softbody_recordings/ros/replay.h"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "softbody_common/images/object_texture.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_recordings/ros/cut_journal.h"
#include "softbody_recordings/ros/graph_config.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/result_bag.h"
#include "softbody_tracking/depth_unit/depth_unit.h"
#include "softbody_tracking/tool/marker_absence.h"
#include "softbody_tracking/tool/tool_dropout_monitor.h"

namespace softbody {
namespace {

constexpr double kTopologyPeriod_s = 1.0;  // as the nodes

using Warn = std::function<void(const std::string&)>;

void warnAll(const Warn& warn, const std::string& source, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    warn(source.empty() ? warning : fmt::format("{}: {}", source, warning));
}

ObjectModel loadModel(const std::string& object, FileScope scope, const Warn& warn) {
  const ObjectDescription description = loadObjectDescription(object, scope);
  ObjectModel model = buildObjectModel(description);
  if (!description.pins.empty())
    warn(fmt::format("{}: pins have no effect in a replay, because there is no live tf", object));
  warnAll(warn, object, model.warnings);
  return model;
}

/// The body is tracked without its picture, too.
cv::Mat3b loadPicture(const std::string& object, FileScope scope, const Warn& warn) try {
  return readObjectTexture(object, scope);
} catch (const std::invalid_argument& error) {
  warn(fmt::format("the body is searched for without its picture: {}", error.what()));
  return {};
}

GraphConfig configOf(const ReplayOptions& options, const Warn& warn) {
  std::vector<std::string> warnings;
  GraphConfig config = readGraphConfig(options.parameters, &warnings);
  warnAll(warn, "", warnings);
  config.pipeline.forces = options.forces, config.pipeline.placed = options.placed;
  if (!options.simd.empty()) config.pipeline.simulator.simd = options.simd;
  config.pipeline.picture = loadPicture(options.object, options.scope, warn);
  return config;
}

std::optional<ToolDescription> loadTool(const std::string& path, FileScope scope, const Warn& warn) {
  if (path.empty()) return std::nullopt;
  const ToolDescription tool = loadToolDescription(path, scope);
  warnAll(warn, "", tool.warnings);
  return tool;
}

CutJournal loadJournal(const ReplayOptions& options) {
  if (options.journal.empty()) return {};
  return {openBag(options.journal), options.topic_namespace + "/cut"};
}

/// The camera's poses in the output frame.
class CameraPoses {
 public:
  /// @param output_frame if empty, the camera's frame.
  CameraPoses(const std::string& bag, const std::string& output_frame)
      : output_frame_(withoutSlash(output_frame)) {
    if (!output_frame_.empty()) transforms_.emplace(std::vector<std::string>{bag});
  }

  /// @throw tf2::TransformException if the bag has no pose for this stamp.
  Eigen::Isometry3d of(const std_msgs::Header& header) const {
    if (!transforms_) return Eigen::Isometry3d::Identity();
    return transforms_->at(output_frame_, header.frame_id, header.stamp);
  }

  const std::string& outputFrame() const { return output_frame_; }
  std::vector<std::string> warnings() const {
    return transforms_ ? transforms_->warnings() : std::vector<std::string>();
  }

 private:
  std::string output_frame_;
  std::optional<BagTransforms> transforms_;
};

/// Processes frames and writes the results into a bag.
class Replay {
 public:
  Replay(const ReplayOptions& options, const ObjectModel& model, const GraphConfig& config,
         const std::optional<ToolDescription>& tool, Warn warn)
      : warn_(std::move(warn)),
        camera_poses_(options.input,
                      options.output_frame.empty() ? config.output_frame : options.output_frame),
        pipeline_(model, config.pipeline, tool),
        journal_(loadJournal(options)),
        output_(options.output, options.topic_namespace, {options.timing, options.labels}) {
    for (const std::string& warning : camera_poses_.warnings()) warn_(warning);
    output_.setOutputFrame(camera_poses_.outputFrame());
    if (tool) output_.setBlade(tool->blade);
  }

  /// A frame that cannot be used leaves the others as they are.
  void process(RgbdFrame frame, const std_msgs::Header& header) {
    try {
      frame.T_fixed_camera = camera_poses_.of(header);
    } catch (const std::exception& error) {
      return skip(frame, header, error.what());
    }
    const auto start = std::chrono::steady_clock::now();
    FrameOutput result;
    try {
      result = pipeline_.process(frame, journal_.takeUntil(frame.stamp));
    } catch (const std::exception& error) {
      return leaveOut(header, error.what());
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    summary_.milliseconds += elapsed.count();
    countTool(result.tool, header, frame);
    write(result, header);
  }

  ReplaySummary finish() {
    const std::size_t left = journal_.size() + pipeline_.waitingCuts();
    if (left > 0)
      warn_(fmt::format("{} cuts of the journal were not made, because the body was not tracked after them",
                        left));
    output_.finish();
    const std::vector<std::uint32_t>& pieces = pipeline_.surfaceTopology().triangle_pieces;
    summary_.tool_missed = tool_dropouts_.missedFrames();
    if (!tool_dropouts_.cause().empty()) summary_.tool_missed += ". Probably " + tool_dropouts_.cause();
    summary_.pieces = pieces.empty() ? 0 : 1 + *std::max_element(pieces.begin(), pieces.end());
    return summary_;
  }

  const ReplaySummary& summary() const { return summary_; }
  const TetTopology& volumeTopology() const { return pipeline_.volumeTopology(); }
  const MeshTopology& surfaceTopology() const { return pipeline_.surfaceTopology(); }

 private:
  void write(const FrameOutput& result, const std_msgs::Header& header) {
    for (const std::string& warning : result.warnings)
      warn_(fmt::format("at {:.3f} s {}", header.stamp.toSec(), warning));
    count(result);
    const double since_s = secondsBetween(topologies_written_, header.stamp);
    if (since_s < 0.0 || since_s >= kTopologyPeriod_s || !result.cuts.empty()) {
      output_.writeTopologies(pipeline_, header.stamp);
      topologies_written_ = header.stamp;
    }
    output_.writeFrame(result, header);
  }

  void leaveOut(const std_msgs::Header& header, const std::string& why) {
    if (summary_.failed++ == 0)
      warn_(fmt::format("frame at {:.3f} s left out: {}", header.stamp.toSec(), why));
    last_status_.state = TrackingState::kDegraded;
    last_status_.reason = "frame left out: " + why;
    count(TrackingStatus(last_status_));
    output_.writeStatus(last_status_, header);
  }

  void skip(const RgbdFrame& frame, const std_msgs::Header& header, const std::string& why) {
    if (summary_.skipped++ == 0)
      warn_(fmt::format("frame at {:.3f} s skipped: {}", header.stamp.toSec(), why));
    count(skippedFrame(last_status_, header.frame_id, camera_poses_.outputFrame(), why));
    output_.writeStatus(last_status_, header);
    const std::optional<ToolObservation> tool = pipeline_.processUnplaced(frame);
    countTool(tool, header, frame);
    if (tool) output_.writeTool(*tool, header);
  }

  void countTool(const std::optional<ToolObservation>& tool, const std_msgs::Header& header,
                 const RgbdFrame& frame) {
    if (!pipeline_.toolTracker()) return;
    summary_.tools += tool && !tool->ambiguous ? 1 : 0;
    const auto missing = tool_dropouts_.update(
        toNanoseconds(header.stamp), tool, pipeline_.toolTracker()->reason(),
        [&] { return whyMarkersAreMissed(pipeline_.toolTracker()->tool(), frame.color); });
    if (missing) warn_(fmt::format("at {:.3f} s {}", header.stamp.toSec(), *missing));
  }

  void count(const TrackingStatus& status) {
    last_status_ = status;
    ++summary_.frames_by_state[status.state];
    summary_.reasons[status.state] = status.reason;
  }

  void count(const FrameOutput& result) {
    summary_.states += result.surface ? 1 : 0;
    summary_.cuts += static_cast<int>(result.cuts.size());
    count(result.tracking.status);
  }

  Warn warn_;
  CameraPoses camera_poses_;
  TrackingStatus last_status_;
  Pipeline pipeline_;
  ToolDropoutMonitor tool_dropouts_;
  CutJournal journal_;
  ResultBag output_;
  ReplaySummary summary_;
  ros::Time topologies_written_;
};

}  // namespace

ReplaySummary replay(const ReplayOptions& options, const Warn& warn,
                     const std::function<void(double)>& progress) {
  const GraphConfig config = configOf(options, warn);
  const ObjectModel model = loadModel(options.object, options.scope, warn);
  const rosbag::Bag input = openBag(options.input);
  Replay run(options, model, config, loadTool(options.tool, options.scope, warn), warn);
  CameraIngest ingest(config.ingest);
  BagFramesConfig frames{options.camera, config.pairing};
  if (frames.camera.depth_scale == 0.0) frames.camera.depth_scale = config.depth_scale;
  CameraImages first;  // with depth
  BagFramesUse use;
  use.note = warn;
  use.frame = [&](const CameraImages& images, const std_msgs::Header& header, double share) {
    if (first.depth.empty()) first = images, first.depth = images.depth.clone();
    run.process(ingest.process(images), header);
    progress(share);
  };
  const BagFramesReport read = readBagImages(input, frames, use);
  if (run.summary().frames_by_state.empty()) {
    throw std::runtime_error(fmt::format("{} holds no usable frame{}{}", options.input,
                                         read.last_error.empty() ? "" : ": ", read.last_error));
  }
  if (run.summary().states == 0) {
    const std::optional<double> unit_m = depthUnitThatFits(first, &ingest, config.pipeline.tracker,
                                                           run.volumeTopology(), run.surfaceTopology());
    throw std::runtime_error(fmt::format(
        "no frame of {} gave a surface: {}{}", options.input, run.summary().reasons.begin()->second,
        unit_m ? fmt::format("; depth shows the body in its size if its unit is {} m: set depth_scale to {} "
                             "(--depth-scale {}, or the parameter of camera_ingest)",
                             *unit_m, *unit_m, *unit_m)
               : ""));
  }
  ReplaySummary summary = run.finish();
  summary.read = read;
  return summary;
}

}  // namespace softbody
