#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <vector>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/fuzz_run.h"
#include "fuzz/messages/message_mutator.h"
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
  const FuzzReport report = fuzzNode(GetParam(), 1, {2000, 2.0});
  EXPECT_EQ(report.fault, "");
  EXPECT_GT(report.messages, 0u);
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
