#include "nodelet_loader/nodelet_loader.h"

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <csignal>
#include <utility>

namespace softbody {
namespace {

constexpr double kPeriod_s = 0.05;

volatile std::sig_atomic_t end_requested = 0;

void requestEnd(int) { end_requested = 1; }

/// `rosnode kill`: roscpp's own answer closes all connections before the nodelet can be unloaded.
void onShutdownCall(XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
  end_requested = 1;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

/// Wall time: the ROS clock may stand still.
void waitBriefly() { ros::WallDuration(kPeriod_s).sleep(); }

}  // namespace

NodeletLoader::NodeletLoader(std::string type, const std::string& manager)
    : name_(ros::this_node::getName()), type_(std::move(type)), manager_(ros::names::resolve(manager)) {
  std::signal(SIGINT, requestEnd);
  std::signal(SIGTERM, requestEnd);
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", onShutdownCall);
}

int NodeletLoader::run() {
  while (connect()) {
    if (!managerHasNodelet() && !load()) {
      if (!session_.isValid()) continue;
      ROS_FATAL_STREAM(
          "nodelet " << name_ << " of type " << type_ << " does not start in " << manager_
                     << ": see the manager's message, and correct the parameter or file it names");
      return 1;
    }
    watch();
  }
  unload();
  return 0;
}

bool NodeletLoader::connect() {
  while (!end_requested) {
    session_ = handle_.serviceClient<nodelet::NodeletList>(manager_ + "/list", true);
    nodelet::NodeletList list;
    if (session_.isValid() && session_.call(list)) return true;
    waitBriefly();
  }
  return false;
}

bool NodeletLoader::managerHasNodelet() {
  nodelet::NodeletList list;
  if (!session_.call(list)) return false;
  const std::vector<std::string>& loaded = list.response.nodelets;
  return std::find(loaded.begin(), loaded.end(), name_) != loaded.end();
}

bool NodeletLoader::load() {
  nodelet::NodeletLoad request;
  request.request.name = name_;
  request.request.type = type_;
  for (const auto& [from, to] : ros::names::getRemappings()) {
    request.request.remap_source_args.push_back(from);
    request.request.remap_target_args.push_back(to);
  }
  return ros::service::call(manager_ + "/load_nodelet", request) && request.response.success;
}

void NodeletLoader::watch() const {
  while (!end_requested && session_.isValid()) waitBriefly();
}

void NodeletLoader::unload() {
  // With the whole graph, the manager ends too.
  if (!session_.isValid()) return;
  nodelet::NodeletUnload request;
  request.request.name = name_;
  ros::service::call(manager_ + "/unload_nodelet", request);
}

}  // namespace softbody
