#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/fuzz_run.h"
#include "fuzz/messages/mutation.h"
#include "fuzz/messages/target.h"
#include "softbody_common/ros/transform_input.h"

namespace softbody::fuzz {
namespace {

struct RosAround : testing::Environment {
  void SetUp() override { LoneRos::instance(); }
  void TearDown() override { LoneRos::end(); }
};
[[maybe_unused]] const testing::Environment* const kRosAround =
    testing::AddGlobalTestEnvironment(new RosAround);

std::vector<std::string> nodeNames() {
  std::vector<std::string> names;
  for (const TargetKind& kind : targetKinds()) names.push_back(kind.name);
  return names;
}

class FuzzMessages : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Nodes, FuzzMessages, testing::ValuesIn(nodeNames()),
                         [](const auto& info) { return info.param; });

/// `make fuzz` gives many more.
TEST_P(FuzzMessages, ANodeWorksAfterMutatedMessages) {
  const FuzzReport report = fuzzNode(GetParam(), 1, 500);
  EXPECT_EQ(report.fault, "");
  EXPECT_GT(report.messages, 0u);
}

/// The nodelets of all packages, in small letters. The virtual camera has no input.
std::set<std::string> nodelets() {
  std::set<std::string> names;
  for (const auto& package : std::filesystem::directory_iterator(CONFIG_DIR "/../..")) {
    std::ifstream file(package.path() / "nodelet_plugins.xml");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::regex nodelet("class name=\"\\w+/(\\w+)");
    for (std::sregex_iterator found(text.begin(), text.end(), nodelet), end; found != end; ++found) {
      std::string name = (*found)[1];
      for (char& letter : name) letter = static_cast<char>(std::tolower(letter));
      names.insert(name);
    }
  }
  names.erase("virtualcamera");
  return names;
}

/// A parameter makes it run after the nodes: rviz stays, and a stamp near the end of time on /tf ends its
/// listener.
class AfterAllNodes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Once, AfterAllNodes, testing::Values(0));

/// tf is one listener for all nodes, and a target of its own.
TEST_P(AfterAllNodes, EveryInputOfEveryNodeletIsFuzzed) {
  for (const TargetKind& kind : targetKinds()) kind.make()->inputs.clear();
  const LoneRos& ros = LoneRos::instance();
  std::set<std::string> missing = nodelets();
  EXPECT_GT(missing.size(), 8u);
  for (const std::string& input : ros.heard) {
    const std::size_t space = input.find(' ');
    EXPECT_TRUE(ros.fuzzed.count(input) + ros.fuzzed.count("/softbody/tf" + input.substr(space)) > 0)
        << input;
    std::string node = input.substr(0, space).substr(std::string("/softbody/").size());
    node.erase(std::remove(node.begin(), node.end(), '_'), node.end());
    missing.erase(node);
  }
  EXPECT_TRUE(missing.empty()) << *missing.begin() << " is not fuzzed";
}

/// A frame whose time went back less often than another's: tf2 must forget its later transforms, too.
TEST(TransformInput, EveryFrameComesBackFromALeapInTime) {
  TransformInput* input = nullptr;
  DrivenNode node("tf", {}, [&](const auto&, const auto&) {
    const auto made = std::make_shared<TransformInput>();
    input = made.get();
    return made;
  });
  const ros::Publisher publisher = node.handle().advertise<tf2_msgs::TFMessage>("/tf", 10);
  const auto send = [&](const std::string& child, double from_s) {
    for (int i = 0; i < 5; ++i) {
      const auto message = boost::make_shared<tf2_msgs::TFMessage>();
      message->transforms.resize(1);
      message->transforms[0].header.frame_id = "base";
      message->transforms[0].header.stamp.fromSec(from_s + 0.03 * i);
      message->transforms[0].child_frame_id = child;
      message->transforms[0].transform.rotation.w = 1.0;
      publisher.publish(message);
      ros::WallDuration(0.002).sleep();  // tf has a thread of its own
    }
    const ros::Time last(from_s + 0.12);
    EXPECT_TRUE(node.processUntil([&] { return input->buffer().canTransform("base", child, last); }))
        << child << " at " << from_s;
  };
  for (const double leap : {5e3, 6e3, 7e3}) {
    send("often", leap);
    send("often", 2e3);
  }
  send("seldom", 1e4);
  send("seldom", 2e3);
}

}  // namespace
}  // namespace softbody::fuzz
