#include "nodes/simulator_node.h"

#include <boost/make_shared.hpp>

#include "softbody_common/conversions.h"
#include "softbody_common/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_msgs/MeshState.h"
#include "softbody_msgs/StageTiming.h"
#include "softbody_sim/object_model.h"

namespace softbody {

SimulatorNode::SimulatorNode(ros::NodeHandle node, ros::NodeHandle private_node) {
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
}

void SimulatorNode::onTargets(const softbody_msgs::TargetsConstPtr& message) {
  restartIfTimeJumpedBack(message->header.stamp);
  try {
    step(*message);
  } catch (const std::exception& error) {
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
    publishTopology();
  }
  last_stamp_ = stamp;
}

void SimulatorNode::step(const softbody_msgs::Targets& message) {
  const TargetSet targets = fromMessage(message);
  const auto scope = timer_.stage("Soft-body Simulation");
  simulator_->step(targets, toNanoseconds(message.header.stamp));
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

}  // namespace softbody
