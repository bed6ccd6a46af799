#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_common/time/stage_timer.h"
#include "softbody_recordings/pipeline/body_surroundings.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/forces/force_schedule.h"
#include "softbody_sim/object/material_parameters.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_tracking/tool/tool_mask.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {

/// The output of the graph's nodes for one frame.
struct FrameOutput {
  bool predicted = false;   ///< without an image: only the simulation went on
  TrackingResult tracking;  ///< empty if predicted
  cv::Size image;           ///< size of the frame [px]
  Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
  std::optional<MeshState> volume;  ///< in the fixed frame, as the surface; empty until the body is found
  std::optional<MeshState> surface;
  std::optional<ForceEstimate> forces;   ///< in the fixed frame; empty if not wanted
  std::vector<NamedReaction> reactions;  ///< of pins and obstacles; without frame: in the fixed frame
  std::optional<ToolObservation> tool;
  std::vector<Cut> cuts;              ///< of this frame; the states have the revision after these cuts
  std::vector<std::string> warnings;  ///< reasons why a cut was not made; what happens to pins and obstacles
  std::vector<StageTime> times;
};

struct PipelineConfig {
  TrackerConfig tracker;
  SimulatorConfig simulator;
  MaterialParameters material = {};  ///< replaces values of the object's material
  CuttingConfig cutting;
  ToolTrackerConfig tool_tracker;
  SurroundingsConfig surroundings;
  std::vector<PinRegion> pins = {};  ///< of the object
  cv::Mat3b picture = {};            ///< of the object, see BodyTracker
  bool forces = false;               ///< also estimate the external forces
  bool placed = false;               ///< the body's initial pose is taken as it is, without a search
};

/// Trackers, simulator and surface in sequence, without ROS. Each frame uses exactly the previous frame's
/// state.
class Pipeline {
 public:
  /// @param tool to track; its blade cuts. Empty: no tool.
  /// @throw std::invalid_argument if the body is to be placed, and has no initial pose, or if a pin holds
  /// nothing.
  Pipeline(const ObjectModel& model, const PipelineConfig& config,
           const std::optional<ToolDescription>& tool = std::nullopt);
  Pipeline(const Pipeline&) = delete;  ///< the body calls the simulator beside it
  Pipeline& operator=(const Pipeline&) = delete;

  const TetTopology& volumeTopology() const { return simulator_.topology(); }
  const MeshTopology& surfaceTopology() const { return body_.surface().topology(); }

  /// A frame of another pass starts with the uncut body, as the graph's nodes do.
  /// @param cuts of this frame, e.g. from a journal, in addition to the tool's cuts. They wait until the body
  /// is tracked. @param surroundings of this frame.
  FrameOutput process(const RgbdFrame& frame, const std::vector<Cut>& cuts = {},
                      const SurroundingsInput& surroundings = {});

  /// Goes on to a stamp without an image: only elasticity, gravity, pins and obstacles act, and the loads
  /// that were estimated last. Nothing comes out before the body is tracked.
  FrameOutput predict(const RgbdFrame& frame, const std::vector<Cut>& cuts,
                      const SurroundingsInput& surroundings);

  /// Tracks only the tool, in the camera's frame. For a frame without a camera pose, which body and blade
  /// need.
  std::optional<ToolObservation> processUnplaced(RgbdFrame frame);

  /// Empty without a tool.
  const std::optional<ToolTracker>& toolTracker() const { return tool_tracker_; }

  /// Number of given cuts that still wait for the body.
  std::size_t waitingCuts() const { return waiting_cuts_.size(); }

 private:
  CuttableBody makeBody();
  void startPass();
  std::optional<ToolObservation> trackTool(const RgbdFrame& frame, const SurroundingsInput& surroundings);
  void simulate(const TargetSet& targets, Nanoseconds stamp, const SurroundingsInput& input,
                FrameOutput* output);
  void addShape(FrameOutput* output);
  void addReactions(const TargetSet& targets, FrameOutput* output);
  void makeWaitingCuts(FrameOutput* output);
  std::optional<Points> seenBlade(const RgbdFrame& frame, const FrameOutput& output) const;
  void followBlade(const Points& blade, Nanoseconds stamp, FrameOutput* output);
  void tear(const TargetSet& targets, FrameOutput* output);
  void announce(const Cut& cut, FrameOutput* output);

  const TetTopology uncut_volume_;
  const MeshTopology uncut_surface_;
  const CuttingConfig cutting_;
  const bool forces_;
  bool to_be_placed_;
  StageTimer timer_;
  BodyTracker tracker_;
  Simulator simulator_;
  CuttableBody body_;  ///< the simulator follows it
  BodySurroundings surroundings_;
  ForceSchedule force_schedule_;
  std::optional<ToolTracker> tool_tracker_;
  ToolMask tool_mask_;
  std::vector<Cut> waiting_cuts_;
  int pass_ = 0;  ///< of the last frame
};

}  // namespace softbody
