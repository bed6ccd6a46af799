#include "softbody_bringup/pipeline.h"

namespace softbody {

Pipeline::Pipeline(const ObjectModel& model, const TrackerConfig& tracker, const SimulatorConfig& simulator)
    : tracker_(tracker), simulator_(model.volume, model.material, simulator), surface_([&] {
        const auto scope = timer_.stage("Resolution Enhancement", true);
        return VisualSurface(model.visual, model.volume);
      }()) {
  tracker_.setTopologies(simulator_.topology(), surface_.topology());
}

FrameOutput Pipeline::process(const RgbdFrame& frame) {
  FrameOutput output;
  const bool simulated = simulator_.placed();
  output.tracking = tracker_.track(frame, simulated ? &simulator_.state() : nullptr, &timer_);
  if (output.tracking.has_targets) simulate(output.tracking.targets, frame.stamp, &output);
  output.times = timer_.take();
  return output;
}

void Pipeline::simulate(const TargetSet& targets, Nanoseconds stamp, FrameOutput* output) {
  {
    const auto scope = timer_.stage("Soft-body Simulation", targets.reset);
    simulator_.step(targets, stamp);
  }
  const auto scope = timer_.stage("Resolution Enhancement");
  output->volume = simulator_.state();
  output->surface = surface_.apply(simulator_.state());
}

}  // namespace softbody
