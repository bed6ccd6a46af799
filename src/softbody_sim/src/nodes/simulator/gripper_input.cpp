#include "nodes/simulator/gripper_input.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace softbody {

GripperInput::GripperInput(ros::NodeHandle node, ros::NodeHandle private_node,
                           const SurroundingsConfig& config, const Simulator* simulator,
                           SurroundingsTracker* surroundings)
    : gripper_(*config.gripper),
      simulator_(simulator),
      surroundings_(surroundings),
      closed_(node.subscribe(config.gripper_closed, 10, &GripperInput::onClosed, this)),
      grip_(private_node.advertiseService("grip", &GripperInput::onGrip, this)) {}

void GripperInput::onClosed(const std_msgs::BoolConstPtr& message) {
  const bool closed = message->data != 0;
  if (std::exchange(said_closed_, closed) == closed) return;
  if (!closed) {
    surroundings_->removePin(gripper_.name);
    return;
  }
  try {
    close();
  } catch (const std::invalid_argument& error) {
    ROS_WARN_STREAM("the gripper closes: " << error.what());
  }
}

bool GripperInput::onGrip(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) try {
  if (request.data != 0)
    response.message = fmt::format("{} vertices are held", close());
  else if (!surroundings_->removePin(gripper_.name))
    response.message = "nothing was held";
  response.success = 1;
  return true;
} catch (const std::invalid_argument& error) {
  response.message = error.what();
  return true;
}

std::size_t GripperInput::close() {
  return surroundings_->grip(gripper_, simulator_->topology(),
                             simulator_->placed() ? simulator_->state().vertices : Points());
}

}  // namespace softbody
