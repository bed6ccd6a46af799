#include "fuzz/messages/driven_node.h"

#include <console_bridge/console.h>
#include <ros/console.h>
#include <sys/prctl.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcServer.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

namespace softbody::fuzz {

namespace {

/// @return the address of a master that ends with this process.
std::string startMaster() {
  XmlRpc::XmlRpcServer probe;
  probe.bindAndListen(0);
  const std::string port = std::to_string(probe.get_port());
  probe.shutdown();
  if (fork() == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    execlp("rosmaster", "rosmaster", "--core", "-p", port.c_str(), nullptr);
    _exit(1);
  }
  return "http://127.0.0.1:" + port;
}

/// Topics and services of this process that somebody can use.
std::set<std::string> inputs() {
  constexpr int kSubscribers = 1, kServices = 2;
  XmlRpc::XmlRpcValue call, result, state;
  call[0] = ros::this_node::getName();
  ros::master::execute("getSystemState", call, result, state, true);
  std::set<std::string> names;
  for (const int kind : {kSubscribers, kServices}) {
    for (int k = 0; k < state[kind].size(); ++k) names.insert(state[kind][k][0]);
  }
  return names;
}

}  // namespace

LoneRos& LoneRos::instance() {
  static LoneRos& ros = *new LoneRos;  // ROS ends after all static objects, and asks its master then
  return ros;
}

LoneRos::LoneRos() {
  ros::init(ros::M_string{{"__master", startMaster()}, {"__ip", "127.0.0.1"}}, "fuzz_messages",
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
  LoneRos& ros = LoneRos::instance();
  ros::param::del(this->name());
  if (parameters.valid()) ros::param::set(this->name(), parameters);
  handle_.setCallbackQueue(&callbacks_);
  private_handle_.setCallbackQueue(&callbacks_);
  const std::set<std::string> before = inputs();
  node_ = make(handle_, private_handle_);
  for (const std::string& input : inputs())
    if (before.count(input) == 0) ros.heard.insert(this->name() + " " + input);
}

void DrivenNode::noteFuzzed(const std::string& input) {
  LoneRos::instance().fuzzed.insert(name() + " " + input);
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
