#include "nodes/simulator/surroundings_input.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

std::string nobodyHasTheName(const std::string& name, const SurroundingsTracker& surroundings) {
  const std::vector<std::string> names = surroundings.names();
  return fmt::format("no pin or obstacle has the name '{}'; known names: {}", name.substr(0, 100),
                     names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

ObstacleDescription obstacleOf(const softbody_msgs::SetObstacleRequest& request) try {
  return fromMessage(request);
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(fmt::format("obstacle '{}': {}", request.name.substr(0, 100), error.what()));
}

}  // namespace

SurroundingsInput::SurroundingsInput(ros::NodeHandle node, ros::NodeHandle private_node,
                                     const Simulator* simulator, SurroundingsTracker* surroundings)
    : simulator_(simulator),
      surroundings_(surroundings),
      pin_subscriber_(node.subscribe(topics::kPin, 10, &SurroundingsInput::onPinMessage, this)),
      pin_(private_node.advertiseService("pin", &SurroundingsInput::onPin, this)),
      set_obstacle_(private_node.advertiseService("set_obstacle", &SurroundingsInput::onSetObstacle, this)),
      release_(private_node.advertiseService("release", &SurroundingsInput::onRelease, this)) {}

void SurroundingsInput::onPinMessage(const softbody_msgs::PinRegionConstPtr& message) {
  if (message->release) {
    if (!surroundings_->removePin(message->name))
      ROS_WARN_STREAM("no pin to release: none has the name '" << message->name << "'");
    return;
  }
  try {
    surroundings_->addPin(fromMessage(*message), simulator_->topology());
    surroundings_->waitingForFrame(message->name);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM("pin '" << message->name << "' is not added: " << error.what());
  }
}

bool SurroundingsInput::onPin(softbody_msgs::Pin::Request& request,
                              softbody_msgs::Pin::Response& response) try {
  const std::size_t count = surroundings_->addPin(fromMessage(request), simulator_->topology());
  response.vertices = static_cast<std::uint32_t>(count);
  response.message = surroundings_->waitingForFrame(request.name);
  response.success = 1;
  return true;
} catch (const std::invalid_argument& error) {
  response.message = error.what();
  return true;
}

bool SurroundingsInput::onSetObstacle(softbody_msgs::SetObstacle::Request& request,
                                      softbody_msgs::SetObstacle::Response& response) try {
  if (!request.shape.empty())
    surroundings_->setObstacle(obstacleOf(request));
  else if (!surroundings_->moveObstacle(request.name, request.header.frame_id, fromMessage(request.pose)))
    throw std::invalid_argument(nobodyHasTheName(request.name, *surroundings_) +
                                "; a new obstacle needs a shape: plane, sphere, capsule or box");
  response.message = surroundings_->waitingForFrame(request.name);
  response.success = 1;
  return true;
} catch (const std::invalid_argument& error) {
  response.message = error.what();
  return true;
}

bool SurroundingsInput::onRelease(softbody_msgs::Release::Request& request,
                                  softbody_msgs::Release::Response& response) {
  const bool done = surroundings_->removePin(request.name) || surroundings_->removeObstacle(request.name);
  response.success = static_cast<unsigned char>(done);
  if (!done) response.message = nobodyHasTheName(request.name, *surroundings_);
  return true;
}

}  // namespace softbody
