#include <softbody_msgs/MeshState.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <string>
#include <vector>

#include "replay/recordings.h"
#include "softbody_recordings/ros/object_namespaces.h"
#include "softbody_recordings/ros/replay.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;
const std::string kSponge = CONFIG_DIR "/sponge.yaml", kDoll = CONFIG_DIR "/doll.yaml";

class SeveralBodies : public testing::Test {
 protected:
  ReplaySummary run(const std::vector<std::string>& objects, const std::string& output) {
    ReplayOptions options;
    options.input = kRecording;
    options.objects = objects;
    options.output = folder_ / output;
    return replay(
        options, [this](const std::string& warning) { warnings_.push_back(warning); }, [](double) {});
  }

  std::vector<softbody_msgs::MeshState> states(const std::string& bag, const std::string& name_space) const {
    return test::messagesOf<softbody_msgs::MeshState>(folder_ / bag, name_space + "/surface/state");
  }

  static inline const std::string kRecording = ROSBAGS_DIR "/bend_small.bag";
  const test::ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST(ObjectNamespaces, AreTheNamesOfTheFiles) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(objectNamespaces({"config/sponge.yaml", "/a/doll.yaml"}), (Names{"/sponge", "/doll"}));
  EXPECT_EQ(objectNamespaces({"/a/liver/object.yaml", "/a/liver", "/a/liver/"}),
            (Names{"/liver", "/liver_2", "/liver_3"}));
  EXPECT_EQ(objectNamespaces({"/a/left lung-2.v3.yaml", "/a/7.yaml", "/a/Hüfte.yaml"}),
            (Names{"/left_lung_2_v3", "/body_7", "/H__fte"}));
  EXPECT_EQ(objectNamespaces({"/a/x.yaml", "/a/x_2.yaml", "/b/x.yaml"}), (Names{"/x", "/x_2", "/x_3"}));
}

TEST_F(SeveralBodies, ABodyThatIsNotThereLeavesTheOtherAsItIs) {
  run({kSponge}, "one.bag");
  const ReplaySummary summary = run({kDoll, kSponge}, "two.bag");
  ASSERT_EQ(summary.bodies.size(), 2U);
  EXPECT_EQ(summary.bodies[0].topic_namespace, "/doll");
  EXPECT_EQ(summary.bodies[0].states, 0);
  EXPECT_EQ(summary.bodies[1].states, 45);
  ASSERT_FALSE(warnings_.empty());
  EXPECT_EQ(warnings_.back().rfind("/doll: no frame gave a surface", 0), 0U) << warnings_.back();
  const auto alone = states("one.bag", "/softbody"), beside = states("two.bag", "/sponge");
  ASSERT_EQ(alone.size(), 45U);
  EXPECT_TRUE(alone == beside);
}

}  // namespace
}  // namespace softbody
