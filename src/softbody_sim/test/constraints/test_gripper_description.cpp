#include <gtest/gtest.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>

#include "softbody_sim/constraints/gripper_description.h"

namespace softbody {
namespace {

std::optional<GripperDescription> readGripper(Parameters& given, std::vector<std::string>* unknown) {
  const GripperWords words = gripperParameters().read(given);
  *unknown = words.unknown;
  return gripperOf(words);
}

class GripperDescriptionTest : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  /// The gripper of a YAML, and of parameters beside it.
  std::optional<GripperDescription> read(const std::string& file, const std::string& parameters = "") {
    std::ofstream(path_) << file;
    Parameters given(YAML::Load("{gripper: " + path_ + (parameters.empty() ? "" : ", " + parameters) + "}"));
    return readGripper(given, &unknown_);
  }
  std::string refusalOf(const std::string& file, const std::string& parameters = "") {
    try {
      read(file, parameters);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_ =
      std::filesystem::temp_directory_path() / ("softbody_gripper_" + std::to_string(getpid()) + ".yaml");
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

TEST_F(GripperDescriptionTest, AParameterReplacesWhatTheFileSays) {
  const auto gripper = read("gripper: {frame: hand, fingers: [left, right], closed: /hand/closed}",
                            "gripper_frame: claw, gripper_fingers: one, gripper_closed: /claw/closed, "
                            "gripper_box: [-1, -2, -3, 1, 2, 3]");
  ASSERT_TRUE(gripper);
  EXPECT_EQ(gripper->space.frame, "claw");
  EXPECT_EQ(gripper->space.max, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(gripper->closed, "/claw/closed");
  ASSERT_EQ(gripper->fingers.size(), 1u);
  EXPECT_EQ(gripper->fingers[0].frame, "one");
}

TEST_F(GripperDescriptionTest, AFrameIsEnough) {
  Parameters parameters(YAML::Load("{gripper: tool0}"));
  const auto gripper = readGripper(parameters, &unknown_);
  ASSERT_TRUE(gripper);
  EXPECT_EQ(gripper->space.frame, "tool0");
  EXPECT_GT((gripper->space.max - gripper->space.min).minCoeff(), 0.0);
  EXPECT_TRUE(gripper->fingers.empty());
  EXPECT_EQ(gripper->closed, "gripper/closed");
  Parameters none;
  EXPECT_FALSE(readGripper(none, &unknown_));
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
    EXPECT_NE(message.find(path_), std::string::npos) << message;
    for (const std::string& word : bad.words) EXPECT_NE(message.find(word), std::string::npos) << message;
  }
  EXPECT_NE(refusalOf("gripper: {frame: hand}", "gripper_box: [0, 0, 0, 0, 1, 1]").find("gripper_box"),
            std::string::npos);
  Parameters missing(YAML::Load("{gripper: /nowhere/gripper.yaml}"));
  EXPECT_THROW(readGripper(missing, &unknown_), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
