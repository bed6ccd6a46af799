#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "softbody_common/topics.h"

/// Nodelets of the whole graph are loaded into one manager and unloaded, in any order and at any moment,
/// while a camera publishes. LOAD_ROUNDS: how often.
namespace softbody {
namespace {

constexpr char kManager[] = "/softbody/manager";

struct Nodelet {
  std::string name, type;
};

const std::vector<Nodelet> kGraph{{"/softbody/camera_ingest", "softbody_tracking/CameraIngest"},
                                  {"/softbody/feature_tracker", "softbody_tracking/FeatureTracker"},
                                  {"/softbody/tool_tracker", "softbody_tracking/ToolTracker"},
                                  {"/softbody/pose_marker", "softbody_tracking/PoseMarker"},
                                  {"/softbody/simulator", "softbody_sim/Simulator"},
                                  {"/softbody/surface", "softbody_sim/Surface"}};

/// A number of /proc/PID/status, in kB where it is a size; 0: the process has ended.
long statusOf(int process, const std::string& field) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string word; file >> word;) {
    if (word != field + ":") continue;
    long value = 0;
    file >> value;
    return value;
  }
  return 0;
}

int processOf(const std::string& node) {
  XmlRpc::XmlRpcValue call, result, uri;
  call[0] = call[1] = node;
  if (!ros::master::execute("lookupNode", call, result, uri, false)) return 0;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue me;
  me[0] = ros::this_node::getName();
  return client.execute("getPid", me, result) ? static_cast<int>(result[2]) : 0;
}

/// Publishers, subscribers and services of a node, as the master knows them.
int registrationsOf(const std::string& node) {
  XmlRpc::XmlRpcValue call, result, state;
  call[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", call, result, state, false)) return -1;
  int count = 0;
  for (int kind = 0; kind < state.size(); ++kind) {
    for (int name = 0; name < state[kind].size(); ++name) {
      XmlRpc::XmlRpcValue& nodes = state[kind][name][1];
      for (int k = 0; k < nodes.size(); ++k) count += static_cast<std::string>(nodes[k]) == node;
    }
  }
  return count;
}

class LoadUnload : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService(service("load_nodelet"), 60'000));
    process_ = processOf(kManager);
    ASSERT_GT(process_, 0);
  }

  static std::string service(const std::string& name) { return std::string(kManager) + "/" + name; }

  static bool load(const Nodelet& nodelet) {
    nodelet::NodeletLoad call;
    call.request.name = nodelet.name;
    call.request.type = nodelet.type;
    for (const char* topic : {topics::kCameraColor, topics::kCameraColorInfo, topics::kCameraDepth}) {
      call.request.remap_source_args.push_back(std::string("/softbody/") + topic);
      call.request.remap_target_args.push_back(std::string("/") + topic);
    }
    return ros::service::call(service("load_nodelet"), call) && call.response.success;
  }

  static bool unload(const Nodelet& nodelet) {
    nodelet::NodeletUnload call;
    call.request.name = nodelet.name;
    return ros::service::call(service("unload_nodelet"), call) && call.response.success;
  }

  static std::size_t loaded() {
    nodelet::NodeletList call;
    if (!ros::service::call(service("list"), call)) return std::numeric_limits<std::size_t>::max();
    return call.response.nodelets.size();
  }

  std::vector<Nodelet> inAnyOrder() {
    std::vector<Nodelet> nodelets = kGraph;
    std::shuffle(nodelets.begin(), nodelets.end(), random_);
    return nodelets;
  }

  void pause(unsigned most_ms) { ros::WallDuration(1e-3 * (random_() % most_ms)).sleep(); }

  /// A round ends with an empty manager.
  void round() {
    for (const Nodelet& nodelet : inAnyOrder()) {
      EXPECT_TRUE(load(nodelet)) << nodelet.name;
      if (random_() % 6 == 0) {
        EXPECT_FALSE(load(nodelet)) << nodelet.name << " twice";
      }
      pause(50);
      if (random_() % 8 != 0) continue;  // it ends at once, and comes back
      EXPECT_TRUE(unload(nodelet)) << nodelet.name;
      EXPECT_TRUE(load(nodelet)) << nodelet.name;
    }
    pause(500);
    for (const Nodelet& nodelet : inAnyOrder()) {
      EXPECT_TRUE(unload(nodelet)) << nodelet.name;
      pause(50);
    }
    EXPECT_EQ(loaded(), 0u);
  }

  void expectTheGraphToWork() {
    for (const Nodelet& nodelet : inAnyOrder()) ASSERT_TRUE(load(nodelet)) << nodelet.name;
    ros::NodeHandle handle("/softbody");
    int states = 0;
    const auto subscriber = handle.subscribe<softbody_msgs::MeshState>(
        topics::kSurfaceState, 10, [&](const softbody_msgs::MeshStateConstPtr&) { ++states; });
    constexpr int kEnough = 10;
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(60.0);
    while (states < kEnough && ros::WallTime::now() < deadline)
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    EXPECT_GE(states, kEnough);
    for (const Nodelet& nodelet : kGraph) EXPECT_TRUE(unload(nodelet)) << nodelet.name;
  }

  std::mt19937 random_{3};
  int process_ = 0;
};

TEST_F(LoadUnload, AManagerKeepsItsThreadsAndItsMemory) {
  constexpr int kWarmUp = 2;  // rounds in which libraries and allocators settle
  constexpr long kMostGrowth_kb = 60'000, kMostThreads = 3;
  const char* wanted = std::getenv("LOAD_ROUNDS");
  const int rounds = wanted != nullptr ? std::atoi(wanted) : 3;
  expectTheGraphToWork();
  for (int i = 0; i < kWarmUp; ++i) round();
  const long threads = statusOf(process_, "Threads"), memory_kb = statusOf(process_, "VmRSS");
  const int registrations = registrationsOf(kManager);
  for (int i = 0; i < rounds && !HasFailure(); ++i) round();
  expectTheGraphToWork();
  ros::WallDuration(0.5).sleep();
  const long threads_after = statusOf(process_, "Threads"), memory_after_kb = statusOf(process_, "VmRSS");
  std::printf("%d rounds: threads %ld, then %ld; memory %ld MB, then %ld MB\n", rounds, threads,
              threads_after, memory_kb / 1000, memory_after_kb / 1000);
  EXPECT_EQ(processOf(kManager), process_) << "the manager has ended";
  EXPECT_GT(registrations, 0);
  EXPECT_EQ(registrationsOf(kManager), registrations);
  EXPECT_LE(threads_after, threads + kMostThreads);
  EXPECT_LE(memory_after_kb, memory_kb + kMostGrowth_kb);
}

}  // namespace
}  // namespace softbody

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_load_unload");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
