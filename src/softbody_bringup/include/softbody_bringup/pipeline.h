#pragma once

#include <optional>

#include "softbody_common/stage_timer.h"
#include "softbody_sim/object_model.h"
#include "softbody_sim/simulator.h"
#include "softbody_sim/visual_surface.h"
#include "softbody_tracking/body_tracker.h"

namespace softbody {

/// What the graph's nodes publish for one frame.
struct FrameOutput {
  TrackingResult tracking;
  std::optional<MeshState> volume;  ///< nothing until the body has been found
  std::optional<MeshState> surface;
  std::vector<StageTime> times;
};

/// Tracker, simulator and surface in a row, without ROS: each frame sees exactly the previous frame's state.
class Pipeline {
 public:
  Pipeline(const ObjectModel& model, const TrackerConfig& tracker, const SimulatorConfig& simulator);

  const TetTopology& volumeTopology() const { return simulator_.topology(); }
  const MeshTopology& surfaceTopology() const { return surface_.topology(); }

  FrameOutput process(const RgbdFrame& frame);

 private:
  void simulate(const TargetSet& targets, Nanoseconds stamp, FrameOutput* output);

  StageTimer timer_;
  BodyTracker tracker_;
  Simulator simulator_;
  VisualSurface surface_;
};

}  // namespace softbody
