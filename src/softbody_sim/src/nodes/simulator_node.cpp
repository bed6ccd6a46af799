#include "nodes/simulator_node.h"

#include <fmt/format.h>

#include <boost/make_shared.hpp>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_msgs/MeshState.h"
#include "softbody_msgs/StageTiming.h"
#include "softbody_sim/object/object_model.h"

namespace softbody {

SimulatorNode::SimulatorNode(ros::NodeHandle node, const ros::NodeHandle& private_node)
    : diagnostics_(node, private_node) {
  Parameters parameters = readParameters(private_node);
  const std::string object = parameters.requiredText("object");
  const std::string body_frame = parameters.text("body_frame", "softbody");
  const SimulatorConfig config = readSimulatorConfig(parameters);
  const double free_run_rate_hz = parameters.number("free_run_rate_hz", 30.0, 0.0, 1000.0);
  stall_timeout_s_ = parameters.number("stall_timeout_s", stall_timeout_s_, 0.0, 60.0);
  std::vector<std::string> unknown;
  surroundings_.emplace(node, readObstacles(parameters, &unknown));
  for (const std::string& key : unknown) ROS_WARN_STREAM("unknown parameter " << key << " is ignored");
  warnUnknown(parameters);

  const ObjectDescription description = loadObjectDescription(object);
  const ObjectModel model = buildObjectModel(description);
  for (const PinRegion& pin : description.pins) surroundings_->hold(pin, model.volume.rest_vertices);
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
  cut_subscriber_ =
      node.subscribe(topics::kCut, 20, &SimulatorNode::onCut, this, ros::TransportHints().tcpNoDelay());
  pin_subscriber_ = node.subscribe(topics::kPin, 10, &SimulatorNode::onPin, this);
  if (free_run_rate_hz > 0.0) {
    free_run_timer_ = node.createTimer(ros::Duration(1.0 / free_run_rate_hz),
                                       [this](const ros::TimerEvent&) { freeRun(); });
  }

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
    surroundings_->regionsChanged(simulator_->topology().rest_vertices, {});
    last_stamp_ = last_arrival_ = {};
    holdTopologyFrom({});
  }
}

void SimulatorNode::holdTopologyFrom(const ros::Time& stamp) {
  // A new one: nodelets may still read the one that was sent.
  const std::string frame = topology_message_->header.frame_id;
  topology_message_ = boost::make_shared<softbody_msgs::TetTopology>(toMessage(simulator_->topology()));
  topology_message_->header.frame_id = frame;
  topology_message_->header.stamp = stamp;
  publishTopology();
}

void SimulatorNode::step(const softbody_msgs::Targets& message) {
  TargetSet targets = fromMessage(message);
  restartIfTimeJumpedBack(message.header.stamp);
  const auto scope = timer_.stage("Soft-body Simulation");
  if (targets.reset) surroundings_->forgetPlaces();
  // A body that is being placed is pinned from the next step on, where it then is.
  const Points& vertices = targets.reset ? Points() : simulator_->state().vertices;
  simulator_->step(targets, toNanoseconds(message.header.stamp),
                   surroundings_->at(message.header.frame_id, message.header.stamp, vertices));
  if (topology_message_->header.stamp.isZero()) holdTopologyFrom(message.header.stamp);
  last_stamp_ = message.header.stamp;
  last_header_ = message.header;
  last_arrival_ = ros::Time::now();
  last_targets_ = simulator_->broughtUpToDate(std::move(targets));
  ++steps_;
  if (!simulator_->report().converged) ++steps_not_converged_;
}

/// What deforms the body, a hand say, is not known to have gone because no image comes: the last targets
/// hold.
void SimulatorNode::freeRun() {
  const ros::Duration silence = ros::Time::now() - last_arrival_;
  if (last_arrival_.isZero() || silence < ros::Duration(stall_timeout_s_)) return;
  std_msgs::Header header = last_header_;
  header.stamp += silence;  // as late after the present as the last image was
  try {
    const auto scope = timer_.stage("Soft-body Simulation");
    simulator_->stepUnobserved(
        last_targets_, toNanoseconds(header.stamp),
        surroundings_->at(header.frame_id, header.stamp, simulator_->state().vertices));
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(1.0, "the simulation does not go on without images: " << error.what());
    return;
  }
  publishState(header);
}

void SimulatorNode::onCut(const softbody_msgs::CutConstPtr& message) {
  if (message->revision <= simulator_->topology().revision) return;  // sent again
  std::string reason;
  try {
    const auto scope = timer_.stage("Cutting");
    if (simulator_->apply(fromMessage(*message), &reason)) {
      surroundings_->regionsChanged(simulator_->topology().rest_vertices, simulator_->state().vertices);
      // A body without a place has no frame yet: it holds from the first one, as the uncut one would.
      holdTopologyFrom(simulator_->placed() ? message->header.stamp : ros::Time());
      last_targets_ = simulator_->broughtUpToDate(std::move(last_targets_));
      return;
    }
  } catch (const std::exception& error) {
    reason = error.what();
  }
  ROS_WARN_STREAM("the cut of revision " << message->revision << " is not made: " << reason);
}

void SimulatorNode::onPin(const softbody_msgs::PinRegionConstPtr& message) {
  const bool was_held = surroundings_->release(message->name);
  if (message->release) {
    if (!was_held) ROS_WARN_STREAM("nothing is let go: no pin has the name '" << message->name << "'");
    return;
  }
  const PinRegion region{message->name, message->header.frame_id,
                         Eigen::Vector3d(message->min.x, message->min.y, message->min.z),
                         Eigen::Vector3d(message->max.x, message->max.y, message->max.z)};
  try {
    surroundings_->hold(region, simulator_->topology().rest_vertices);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM("nothing is held: " << error.what());
  }
}

void SimulatorNode::publishState(const std_msgs::Header& header) {
  const auto state = boost::make_shared<softbody_msgs::MeshState>(toMessage(simulator_->state()));
  state->header = header;
  state_publisher_.publish(state);
  surroundings_->publish(simulator_->reactions(), header.stamp);
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
