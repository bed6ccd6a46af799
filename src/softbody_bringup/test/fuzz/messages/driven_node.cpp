#include "fuzz/messages/driven_node.h"

#include <console_bridge/console.h>
#include <ros/console.h>

#include <algorithm>
#include <cstdlib>

namespace softbody::fuzz {

LoneRos& LoneRos::instance() {
  static LoneRos& ros = *new LoneRos;  // ROS ends after all static objects, and asks its master then
  return ros;
}

LoneRos::LoneRos() {
  ros::init(ros::M_string{{"__master", master_.uri()}, {"__ip", "127.0.0.1"}}, "fuzz_messages",
            ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  ros::start();
  if (std::getenv("FUZZ_LOG") == nullptr) {
    // A refusal writes a warning: a million of them would hide everything else.
    ros::console::set_logger_level("ros", ros::console::levels::Fatal);
    ros::console::notifyLoggerLevelsChanged();
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);  // of tf2
  }
  ros::Time::setNow(now_);
}

void LoneRos::advance(double seconds) {
  now_.fromSec(std::max(1.0, now_.toSec() + seconds));
  ros::Time::setNow(now_);
}

DrivenNode::DrivenNode(const std::string& name, const XmlRpc::XmlRpcValue& parameters, const Make& make)
    : handle_("/softbody"), private_handle_("/softbody/" + name) {
  LoneRos::instance().master().setParameters("/softbody/" + name, parameters);
  handle_.setCallbackQueue(&callbacks_);
  private_handle_.setCallbackQueue(&callbacks_);
  node_ = make(handle_, private_handle_);
}

DrivenNode::~DrivenNode() {
  node_.reset();
  callbacks_.clear();
}

void DrivenNode::process() {
  do {
    callbacks_.callAvailable();
    ros::getGlobalCallbackQueue()->callAvailable();  // of the interactive markers
  } while (!callbacks_.isEmpty());
}

bool DrivenNode::processUntil(const std::function<bool()>& condition) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(10.0);
  while (!condition()) {
    if (ros::WallTime::now() > deadline) return false;
    callbacks_.callAvailable(ros::WallDuration(0.001));
    ros::getGlobalCallbackQueue()->callAvailable();
  }
  return true;
}

}  // namespace softbody::fuzz
