#include "nodes/simulator/simulator_node.h"

#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/topics.h"

namespace softbody {
namespace {

constexpr char kStage[] = "Soft-body Simulation";

Simulator makeSimulator(const ObjectModel& model, const SimulatorConfig& config, StageTimer* timer) {
  const auto scope = timer->stage(kStage, true);
  return {model.volume, model.material, config};
}

}  // namespace

SimulatorNode::SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : SimulatorNode(node, private_node, readSimulatorOptions(private_node)) {}

SimulatorNode::SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                             const SimulatorOptions& options)
    : SimulatorNode(node, private_node, options, loadSimulatedObject(options.object, options.scope)) {}

SimulatorNode::SimulatorNode(ros::NodeHandle node, const ros::NodeHandle& private_node,
                             const SimulatorOptions& options, const SimulatedObject& object)
    : stall_timeout_s_(options.stall_timeout_s),
      simulator_(makeSimulator(object.model, options.simulator, &timer_)),
      surroundings_(node, options.obstacles, options.pins),
      stamps_(node.resolveName(topics::kTargets)),
      publisher_(node, options.body_frame, object.model.volume),
      diagnostics_(node, private_node, &simulator_, &surroundings_) {
  for (const PinRegion& pin : object.pins) surroundings_.addPin(pin, object.model.volume.rest_vertices);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  targets_subscriber_ = node.subscribe(topics::kTargets, 1, &SimulatorNode::onTargets, this, hints);
  cut_subscriber_ = node.subscribe(topics::kCut, 20, &SimulatorNode::onCut, this, hints);
  pin_subscriber_ = node.subscribe(topics::kPin, 10, &SimulatorNode::onPin, this);
  if (options.free_run_rate_hz > 0.0) {
    free_run_timer_ = node.createTimer(toDuration(nanoseconds(1.0 / options.free_run_rate_hz)),
                                       [this](const ros::TimerEvent&) { onFreeRun(); });
  }
}

void SimulatorNode::onTargets(const softbody_msgs::TargetsConstPtr& message) {
  try {
    if (!step(*message)) return diagnostics_.countRefusedMessage();
  } catch (const std::exception& error) {
    diagnostics_.countRefusedMessage();
    ROS_WARN_STREAM_THROTTLE(1.0,
                             "targets of " << message->header.stamp << " are not used: " << error.what());
    return;
  }
  publishState(message->header);
}

/// @return whether the stamp is accepted; if not, nothing changes. @throw std::invalid_argument likewise.
bool SimulatorNode::step(const softbody_msgs::Targets& message) {
  TargetSet targets = fromMessage(message);
  simulator_.requireUsable(targets);
  if (!admits(message.header.stamp)) return false;
  const auto scope = timer_.stage(kStage);
  if (targets.reset) surroundings_.forgetPinPositions();
  // When the body is placed, its pins take their positions after this step.
  const Points& vertices = targets.reset ? Points() : simulator_.state().vertices;
  simulator_.step(targets, toNanoseconds(message.header.stamp),
                  surroundings_.surroundingsAt(message.header.frame_id, message.header.stamp, vertices));
  if (!publisher_.topologyHasStamp()) publisher_.publishTopology(simulator_.topology(), message.header.stamp);
  last_ = {simulator_.toCurrentRevision(std::move(targets)), message.header, ros::Time::now()};
  surroundings_.findConflicts(last_.set.targets, simulator_.topology().tets, simulator_.state().vertices);
  diagnostics_.countStep();
  return true;
}

/// Several target sets may belong to one stamp.
bool SimulatorNode::admits(const ros::Time& stamp) {
  const StampVerdict verdict = stamps_.judge(stamp);
  if (verdict.kind == StampVerdict::kJumpedBack) restart();
  return verdict.accepted() || verdict.kind == StampVerdict::kRepeated;
}

void SimulatorNode::restart() {
  ROS_INFO("time jumped back: the simulation starts again with the uncut body");
  simulator_.reset();
  surroundings_.updatePins(simulator_.topology().rest_vertices, {});
  last_ = {};
  publisher_.publishTopology(simulator_.topology(), {});
}

/// Without images nobody knows whether the hands that deform the body are gone. So the last targets stay.
void SimulatorNode::onFreeRun() {
  const Nanoseconds now = toNanoseconds(ros::Time::now()), silence = now - toNanoseconds(last_.arrival);
  if (!clock_.judge(now).accepted() || last_.arrival.isZero() || seconds(silence) < stall_timeout_s_) return;
  std_msgs::Header header = last_.header;
  header.stamp = toTime(toNanoseconds(header.stamp) + silence);  // keeps the latency of the last image
  try {
    const auto scope = timer_.stage(kStage);
    simulator_.stepUnobserved(
        last_.set, toNanoseconds(header.stamp),
        surroundings_.surroundingsAt(header.frame_id, header.stamp, simulator_.state().vertices));
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(1.0, "the simulation cannot continue without images: " << error.what());
    return;
  }
  publishState(header);
}

void SimulatorNode::onCut(const softbody_msgs::CutConstPtr& message) {
  if (message->revision <= simulator_.topology().revision) return;  // sent again
  std::string reason;
  try {
    if (applyCut(*message, &reason)) return;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  ROS_WARN_STREAM("the cut of revision " << message->revision << " is not made: " << reason);
}

bool SimulatorNode::applyCut(const softbody_msgs::Cut& message, std::string* reason) {
  const auto scope = timer_.stage("Cutting");
  if (!simulator_.apply(fromMessage(message), reason)) return false;
  surroundings_.updatePins(simulator_.topology().rest_vertices, simulator_.state().vertices);
  // Only before the body is placed the stamp is 0: then the topology gets the stamp of the first frame.
  const ros::Time& stamp = message.header.stamp.isZero() ? last_.header.stamp : message.header.stamp;
  publisher_.publishTopology(simulator_.topology(), simulator_.placed() ? stamp : ros::Time());
  last_.set = simulator_.toCurrentRevision(std::move(last_.set));
  return true;
}

void SimulatorNode::onPin(const softbody_msgs::PinRegionConstPtr& message) {
  if (message->release) {
    if (!surroundings_.removePin(message->name))
      ROS_WARN_STREAM("no pin to release: none has the name '" << message->name << "'");
    return;
  }
  const PinRegion region{message->name, message->header.frame_id,
                         Eigen::Vector3d(message->min.x, message->min.y, message->min.z),
                         Eigen::Vector3d(message->max.x, message->max.y, message->max.z)};
  try {
    surroundings_.addPin(region, simulator_.topology().rest_vertices);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM("the pin is not added: " << error.what());
  }
}

void SimulatorNode::publishState(const std_msgs::Header& header) {
  publisher_.publishState(simulator_.state(), header);
  surroundings_.publishReactions(simulator_.reactions(), header.stamp);
  publisher_.publishTiming(timer_.take(), header);
}

}  // namespace softbody
