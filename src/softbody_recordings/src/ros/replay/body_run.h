#pragma once

#include <std_msgs/Header.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ros/replay/cut_journal.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_recordings/ros/replay.h"
#include "softbody_recordings/ros/result_bag.h"
#include "softbody_tracking/known/followed_surface.h"
#include "softbody_tracking/tool/tool_dropout_monitor.h"

namespace softbody {

/// What one body of a replay is, and where its output goes.
struct BodyRunSetup {
  std::string topic_namespace;  ///< of its output topics
  std::string output_frame;     ///< of targets and states; empty: the camera's
  ResultBagExtras extras;
  std::optional<ToolDescription> tool;
  CutJournal journal;
};

/// One body of a replay: its pipeline, its topics in the result, and its summary.
class BodyRun {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// @param output the result's bag, which other bodies may share; must outlive the run.
  BodyRun(const ObjectModel& model, const PipelineConfig& config, BodyRunSetup setup, AtomicBag* output,
          Warn warn);

  /// Processes a frame and writes what comes out. A frame that fails leaves the others as they are.
  /// @param others surfaces that are known to be in view, in the camera's frame.
  void process(const RgbdFrame& frame, const std_msgs::Header& header,
               const std::vector<KnownSurface>& others, const SurroundingsInput& surroundings);
  /// Predicts the body at the stamp of a frame, without its image.
  void predict(const RgbdFrame& frame, const std_msgs::Header& header, const SurroundingsInput& surroundings);
  /// A frame without a camera pose: only the tool is tracked.
  void skip(const RgbdFrame& frame, const std_msgs::Header& header, const std::string& why);
  /// Where the body is, from its states so far, for the other bodies; nothing while it is not tracked.
  std::optional<KnownSurface> surface(const RgbdFrame& frame) const;
  /// The summary of all frames.
  const BodySummary& finish();

  const BodySummary& summary() const { return summary_; }
  const TetTopology& volumeTopology() const { return pipeline_.volumeTopology(); }
  const MeshTopology& surfaceTopology() const { return pipeline_.surfaceTopology(); }

 private:
  using Work = std::function<FrameOutput()>;
  void run(const RgbdFrame& frame, const std_msgs::Header& header, const Work& work);
  void follow(const FrameOutput& result, const RgbdFrame& frame);
  void write(const FrameOutput& result, const std_msgs::Header& header);
  void leaveOut(const std_msgs::Header& header, const std::string& why);
  void countTool(const std::optional<ToolObservation>& tool, const std_msgs::Header& header,
                 const RgbdFrame& frame);
  void count(const TrackingStatus& status);
  void count(const FrameOutput& result);

  Warn warn_;
  std::string output_frame_;
  TrackingStatus last_status_;
  Pipeline pipeline_;
  CutJournal journal_;
  ToolDropoutMonitor tool_dropouts_;
  FollowedSurface surface_;
  int pass_ = 0;  ///< of the last frame
  ResultBag output_;
  BodySummary summary_;
  ros::Time topologies_written_;
};

}  // namespace softbody
