#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>

#include "softbody_sim/constraints/gripper_description.h"

namespace softbody {
namespace {

class GripperDescriptionTest : public ::testing::Test {
 protected:
  std::optional<GripperDescription> read(const std::string& file) {
    folder_.write("gripper.yaml", file);
    return readGripper(path_, &unknown_);
  }
  std::string refusalOf(const std::string& file) {
    return complaint([&] { read(file); });
  }

  const test::ScratchFolder folder_;
  const std::string path_ = folder_.file("gripper.yaml");
  std::vector<std::string> unknown_;
};

TEST_F(GripperDescriptionTest, AFileDescribesAllOfIt) {
  const auto gripper = read(
      "gripper: {frame: hand, fingers: [left, right], box: [-1, -2, -3, 1, 2, 3], finger_size: [0.1, 0.2, "
      "0.3], closed: /hand/closed, colour: red}");
  ASSERT_TRUE(gripper);
  EXPECT_EQ(gripper->space.frame, "hand");
  EXPECT_EQ(gripper->space.min, Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(gripper->space.max, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(gripper->closed, "/hand/closed");
  ASSERT_EQ(gripper->fingers.size(), 2u);
  EXPECT_EQ(gripper->fingers[1].frame, "right");
  EXPECT_NE(gripper->fingers[0].name, gripper->fingers[1].name);
  ASSERT_EQ(unknown_.size(), 1u);
  EXPECT_EQ(unknown_.front(), path_ + ": gripper/colour");
}

TEST_F(GripperDescriptionTest, AFrameIsEnough) {
  const auto gripper = readGripper("tool0", &unknown_);
  ASSERT_TRUE(gripper);
  EXPECT_EQ(gripper->space.frame, "tool0");
  EXPECT_GT((gripper->space.max - gripper->space.min).minCoeff(), 0.0);
  EXPECT_TRUE(gripper->fingers.empty());
  EXPECT_EQ(gripper->closed, "gripper/closed");
  EXPECT_FALSE(readGripper("", &unknown_));
}

TEST_F(GripperDescriptionTest, BadFilesAreRefusedWithFileKeyAndValue) {
  const struct {
    std::string file;
    std::vector<std::string> words;
  } cases[] = {
      {"frame: hand", {"gripper/frame", "missing"}},
      {"gripper: {fingers: [left]}", {"gripper/frame", "missing"}},
      {"gripper: hand", {"gripper/", "map"}},
      {"gripper: {frame: hand, fingers: left}", {"gripper/fingers", "list"}},
      {"gripper: {frame: hand, box: [0, 0, 0, 1, 1]}", {"gripper/box"}},
      {"gripper: {frame: hand, box: [0, 0, 0, 1, -1, 1]}", {"gripper/box", "[0, 0, 0, 1, -1, 1]"}},
      {"gripper: {frame: hand, finger_size: [0.01, 0, 1]}", {"gripper/finger_size", "above 0"}},
      {"gripper: [", {"not YAML"}},
  };
  for (const auto& bad : cases) {
    SCOPED_TRACE(bad.file);
    const std::string message = refusalOf(bad.file);
    EXPECT_TRUE(says(message, path_));
    for (const std::string& word : bad.words) EXPECT_TRUE(says(message, word));
  }
  EXPECT_THROW(readGripper("/nowhere/gripper.yaml", &unknown_), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
