#include "nodes/simulator_node.h"

#include <fmt/format.h>

#include <boost/make_shared.hpp>

#include "softbody_common/conversions.h"
#include "softbody_common/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_msgs/MeshState.h"
#include "softbody_msgs/StageTiming.h"
#include "softbody_sim/object_model.h"

namespace softbody {

SimulatorNode::SimulatorNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : diagnostics_(node, private_node) {
  Parameters parameters = readParameters(private_node);
  const std::string object = parameters.requiredText("object");
  const std::string body_frame = parameters.text("body_frame", "softbody");
  const SimulatorConfig config = readSimulatorConfig(parameters);
  warnUnknown(parameters);

  const ObjectModel model = buildObjectModel(loadObjectDescription(object));
  for (const std::string& warning : model.warnings) ROS_WARN_STREAM(object << ": " << warning);
  {
    const auto scope = timer_.stage("Soft-body Simulation", true);
    simulator_.emplace(model.volume, model.material, config);
  }
  topology_message_ = boost::make_shared<softbody_msgs::TetTopology>(toMessage(model.volume));
  topology_message_->header.frame_id = body_frame;

  topology_publisher_ = node.advertise<softbody_msgs::TetTopology>(topics::kVolumeTopology, 1, true);
  state_publisher_ = node.advertise<softbody_msgs::MeshState>(topics::kVolumeState, 1);
  timing_publisher_ = node.advertise<softbody_msgs::StageTiming>(topics::kTiming, 10);
  publishTopology();
  topology_timer_ =
      node.createTimer(ros::Duration(1.0), [this](const ros::TimerEvent&) { publishTopology(); });
  targets_subscriber_ = node.subscribe(topics::kTargets, 1, &SimulatorNode::onTargets, this,
                                       ros::TransportHints().tcpNoDelay());

  diagnostics_.setHardwareID("none");
  diagnostics_.add("simulation",
                   [this](diagnostic_updater::DiagnosticStatusWrapper& status) { diagnose(status); });
  // Wall time, and not at update()'s own pace: both would wait for a bag that starts again.
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void SimulatorNode::onTargets(const softbody_msgs::TargetsConstPtr& message) {
  try {
    step(*message);
  } catch (const std::exception& error) {
    ++refused_;
    ROS_WARN_STREAM_THROTTLE(1.0,
                             "targets of " << message->header.stamp << " are not used: " << error.what());
    return;
  }
  publishState(message->header);
}

void SimulatorNode::restartIfTimeJumpedBack(const ros::Time& stamp) {
  if (stamp < last_stamp_) {
    ROS_INFO("time jumped back by %.3f s: the simulation starts anew", (last_stamp_ - stamp).toSec());
    simulator_->reset();
    last_stamp_ = {};
    publishTopology();
  }
}

void SimulatorNode::step(const softbody_msgs::Targets& message) {
  const TargetSet targets = fromMessage(message);
  restartIfTimeJumpedBack(message.header.stamp);
  const auto scope = timer_.stage("Soft-body Simulation");
  simulator_->step(targets, toNanoseconds(message.header.stamp));
  last_stamp_ = message.header.stamp;
  ++steps_;
  if (!simulator_->report().converged) ++steps_not_converged_;
}

void SimulatorNode::publishState(const std_msgs::Header& header) {
  const auto state = boost::make_shared<softbody_msgs::MeshState>(toMessage(simulator_->state()));
  state->header = header;
  state_publisher_.publish(state);
  const auto timing =
      boost::make_shared<softbody_msgs::StageTiming>(timingMessage("simulator", timer_.take()));
  timing->header = header;
  timing_publisher_.publish(timing);
}

void SimulatorNode::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const StepReport& last = simulator_->report();
  if (refused_ > 0) {
    status.summary(DiagnosticStatus::WARN, fmt::format("{} messages with targets were not used", refused_));
  } else if (!simulator_->placed()) {
    status.summary(DiagnosticStatus::WARN, "the body has no place yet: waiting for targets");
  } else if (steps_not_converged_ > 0) {
    status.summary(DiagnosticStatus::WARN,
                   fmt::format("{} of {} steps did not converge", steps_not_converged_, steps_));
  } else {
    status.summary(DiagnosticStatus::OK, fmt::format("all of {} steps converged", steps_));
  }
  status.add("steps", steps_);
  status.add("steps not converged", steps_not_converged_);
  status.add("messages refused", refused_);
  status.add("iterations of the last step", last.iterations);
  status.add("last step converged", last.converged);
  status.add("residual of the last step [N]", fmt::format("{:.3g}", last.residual_n));
  status.add("last move [mm]", fmt::format("{:.4f}", 1e3 * last.last_move_m));
  steps_ = steps_not_converged_ = refused_ = 0;
}

}  // namespace softbody
