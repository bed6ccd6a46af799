#include "softbody_recordings/pipeline/pipeline.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr char kSimulationStage[] = "Soft-body Simulation";

Simulator makeSimulator(const ObjectModel& model, const PipelineConfig& config, StageTimer* timer) {
  const auto scope = timer->stage(kSimulationStage, true);
  Simulator simulator(model.volume, withParameters(model.material, config.material), config.simulator);
  simulator.prepare();
  return simulator;
}

}  // namespace

Pipeline::Pipeline(const ObjectModel& model, const PipelineConfig& config,
                   const std::optional<ToolDescription>& tool)
    : uncut_volume_(model.volume),
      uncut_surface_(model.visual),
      cutting_(config.cutting),
      forces_(config.forces),
      to_be_placed_(config.placed),
      tracker_(config.tracker, config.picture),
      simulator_(makeSimulator(model, config, &timer_)),
      body_(makeBody()),
      surroundings_(config.surroundings, config.pins, {uncut_surface_, uncut_volume_}, uncut_volume_) {
  if (to_be_placed_ && !uncut_volume_.has_initial_pose)
    throw std::invalid_argument("the object has no initial_pose at which it can be placed");
  if (tool) tool_tracker_.emplace(*tool, config.tool_tracker);
  const auto scope = timer_.stage("Tracker Preparation", true);
  tracker_.setTopologies(volumeTopology(), surfaceTopology());
}

CuttableBody Pipeline::makeBody() {
  const auto scope = timer_.stage("Resolution Enhancement", true);
  return {uncut_surface_, uncut_volume_, cutting_,
          [this](const TetEdits& edits) { simulator_.apply(edits); }};
}

void Pipeline::startPass() {
  simulator_.reset();
  body_ = makeBody();
  waiting_cuts_.clear();
  surroundings_.restart(uncut_volume_);
  tracker_.setTopologies(volumeTopology(), surfaceTopology());
}

FrameOutput Pipeline::process(const RgbdFrame& frame, const std::vector<Cut>& cuts,
                              const SurroundingsInput& surroundings) {
  FrameOutput output;
  output.image = frame.depth.size();
  output.T_fixed_camera = frame.T_fixed_camera;
  if (std::exchange(pass_, frame.pass) != frame.pass) startPass();
  waiting_cuts_.insert(waiting_cuts_.end(), cuts.begin(), cuts.end());
  if (std::exchange(to_be_placed_, false))
    tracker_.placeAt(frame.T_fixed_camera * uncut_volume_.initial_pose);
  const bool simulated = simulator_.placed();
  output.tool = trackTool(frame, surroundings);
  const std::optional<Points> blade = seenBlade(frame, output);
  if (blade) tool_mask_.setBlade(frame.stamp, *blade);
  output.tracking =
      tracker_.track(tool_mask_.withoutBlade(frame), simulated ? &simulator_.state() : nullptr, &timer_);
  if (output.tracking.has_targets) {
    simulate(output.tracking.targets, frame.stamp, surroundings, &output);
    makeWaitingCuts(&output);
    if (blade) followBlade(*blade, frame.stamp, &output);
    tear(output.tracking.targets, &output);
    addShape(&output);
  }
  output.times = timer_.take();
  return output;
}

/// By its markers, or where its frame is.
std::optional<ToolObservation> Pipeline::trackTool(const RgbdFrame& frame,
                                                   const SurroundingsInput& surroundings) {
  if (!tool_tracker_) return std::nullopt;
  const std::string& followed = tool_tracker_->tool().frame;
  if (followed.empty()) return tool_tracker_->track(frame, &timer_);
  std::optional<Eigen::Isometry3d> T_camera_tool;
  if (const std::optional<StampedPose> place = surroundings.lookup(followed, frame.stamp))
    T_camera_tool = frame.T_fixed_camera.inverse() * place->pose;
  return tool_tracker_->follow(frame.stamp, T_camera_tool);
}

FrameOutput Pipeline::predict(const RgbdFrame& frame, const std::vector<Cut>& cuts,
                              const SurroundingsInput& surroundings) {
  FrameOutput output;
  output.predicted = true;
  output.T_fixed_camera = frame.T_fixed_camera;
  waiting_cuts_.insert(waiting_cuts_.end(), cuts.begin(), cuts.end());
  if (!simulator_.placed()) return output;
  TargetSet none;
  none.revision = simulator_.topology().revision;
  {
    const auto scope = timer_.stage(kSimulationStage);
    simulator_.stepUnobserved(none, frame.stamp,
                              surroundings_.before(frame.stamp, surroundings, simulator_, none));
  }
  addReactions(none, &output);
  makeWaitingCuts(&output);
  addShape(&output);
  output.times = timer_.take();
  return output;
}

std::optional<ToolObservation> Pipeline::processUnplaced(RgbdFrame frame) {
  frame.placed = false;
  if (!tool_tracker_) return std::nullopt;
  const bool follows = !tool_tracker_->tool().frame.empty();
  return follows ? tool_tracker_->follow(frame.stamp, std::nullopt) : tool_tracker_->track(frame, nullptr);
}

void Pipeline::simulate(const TargetSet& targets, Nanoseconds stamp, const SurroundingsInput& input,
                        FrameOutput* output) {
  {
    const auto scope = timer_.stage(kSimulationStage);
    simulator_.step(targets, stamp, surroundings_.before(stamp, input, simulator_, targets));
  }
  surroundings_.findConflicts(targets.targets, simulator_);
  addReactions(targets, output);
}

void Pipeline::addShape(FrameOutput* output) {
  const auto scope = timer_.stage("Resolution Enhancement");
  output->volume = simulator_.state();
  output->surface = body_.surface().apply(simulator_.state());
}

/// Those of pins are without the springs of the targets, and left out in frames without an estimate.
void Pipeline::addReactions(const TargetSet& targets, FrameOutput* output) {
  output->warnings = surroundings_.takeLog();
  const Surroundings& around = surroundings_.last();
  Reactions reactions = simulator_.reactions();
  const bool has_springs = !targets.targets.empty();
  if (has_springs) reactions.pins.clear();
  const auto pins_are_due = [&] {
    return has_springs && !around.pins.empty() && force_schedule_.isDue(around.pins, simulator_.stamp());
  };
  if (!output->predicted && (forces_ || pins_are_due())) {
    const auto scope = timer_.stage("Forces");
    ForceEstimate forces = simulator_.externalForces(targets, around);
    if (has_springs) reactions.pins = forces.pins;
    if (forces_) output->forces = std::move(forces);
  }
  output->reactions = surroundings_.named(reactions);
}

void Pipeline::makeWaitingCuts(FrameOutput* output) {
  for (const Cut& given : std::exchange(waiting_cuts_, {})) {
    std::string reason;
    try {
      if (body_.apply(given, simulator_.state(), &reason)) {
        announce(given, output);
        continue;
      }
    } catch (const std::exception& error) {
      reason = error.what();
    }
    output->warnings.push_back(
        fmt::format("the cut of revision {} from the journal was not made: {}", given.revision, reason));
  }
}

/// A predicted blade does not cut. When it is seen again, it continues from its last cut.
std::optional<Points> Pipeline::seenBlade(const RgbdFrame& frame, const FrameOutput& output) const {
  if (!output.tool || !output.tool->cuts || tool_tracker_->tool().blade.rows() == 0) return std::nullopt;
  return transformed(tool_tracker_->tool().blade, frame.T_fixed_camera * output.tool->T_camera_tool);
}

void Pipeline::followBlade(const Points& blade, Nanoseconds stamp, FrameOutput* output) {
  const auto scope = timer_.stage("Cutting");
  std::optional<Cut> own;
  try {
    own = body_.follow(blade, simulator_.state(), stamp);
  } catch (const std::exception& error) {
    output->warnings.push_back(fmt::format("the blade cannot cut: {}", error.what()));
  }
  if (own) announce(*own, output);
}

void Pipeline::tear(const TargetSet& targets, FrameOutput* output) {
  std::optional<Cut> torn;
  try {
    torn = body_.tear(simulator_.state(), targets);
  } catch (const std::exception& error) {
    output->warnings.push_back(fmt::format("the body cannot tear: {}", error.what()));
  }
  if (torn) announce(*torn, output);
}

/// A cut is made: the other models of the body get the new topologies.
void Pipeline::announce(const Cut& cut, FrameOutput* output) {
  surroundings_.update(simulator_);
  tracker_.setTopologies(volumeTopology(), surfaceTopology());
  output->cuts.push_back(cut);
}

}  // namespace softbody
