#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <filesystem>
#include <fstream>

#include "softbody_recordings/ros/graph_config.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class GraphConfigTest : public ::testing::Test {
 protected:
  GraphConfig read(const std::string& yaml) {
    return readGraphConfig(folder_.write("parameters.yaml", yaml), &warnings_);
  }
  std::string refusalOf(const std::string& yaml) {
    return complaint([&] { read(yaml); });
  }

  const test::ScratchFolder folder_;
  const std::string path_ = folder_.file("parameters.yaml");
  std::vector<std::string> warnings_;
};

TEST_F(GraphConfigTest, ReadsEachNodesSection) {
  const GraphConfig config = read(
      "camera_ingest: {sync_tolerance_s: 0, depth_scale: 0.00025}\n"
      "simulator: {iterations: 7, free_run_rate_hz: 0}\n"
      "surface: {min_advance_m: 0.004}\n"
      "tool_tracker:\n");
  EXPECT_EQ(config.pairing.tolerance, 0);
  EXPECT_EQ(config.depth_scale, 0.00025);
  EXPECT_EQ(config.pipeline.simulator.iterations, 7);
  EXPECT_EQ(config.pipeline.cutting.min_advance_m, 0.004);
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(GraphConfigTest, HasDefaultsWithoutAFile) {
  const GraphConfig config = readGraphConfig("", &warnings_);
  EXPECT_EQ(config.pipeline.simulator.iterations, SimulatorConfig().iterations);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(GraphConfigTest, RefusesParametersOutsideOfANodesSection) {
  const std::string refusal = refusalOf("simulator: {iterations: 7}\ntarget_stiffness: 10.0\n");
  EXPECT_TRUE(says(refusal, path_ + ":2:"));
  EXPECT_TRUE(says(refusal, "'target_stiffness'"));
  for (const char* section : {"feature_tracker", "simulator", "tool_tracker"})
    EXPECT_TRUE(says(refusal, section));
}

TEST_F(GraphConfigTest, RefusesWhatIsNoMapOfSections) {
  EXPECT_NE(refusalOf("- simulator\n"), "");
  EXPECT_NE(refusalOf("simulator: 3\n"), "");
  EXPECT_NE(refusalOf(""), "");
  EXPECT_TRUE(says(refusalOf("simulator: {iterations: [\n"), "not YAML"));
}

TEST_F(GraphConfigTest, NamesKeysThatTheNodeDoesNotKnow) {
  read("simulator: {iteration: 7}\n");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(says(warnings_.front(), "simulator/iteration "));
}

TEST_F(GraphConfigTest, KnowsWhatOnlyALiveGraphUses) {
  read(
      "camera_ingest: {voxel_size_m: 0.01, silence_timeout_s: 3, color_transport: raw}\n"
      "feature_tracker: {body_frame: b, mask_timeout_s: 0.2, tf_timeout_s: 0.1}\n"
      "pose_marker: {frame: world}\n"
      "simulator: {object: x.yaml, body_frame: b, free_run_rate_hz: 30}\n"
      "surface: {object: x.yaml, body_frame: b}\n"
      "tool_tracker: {tool: x.yaml, tool_frame: knife}\n");
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(GraphConfigTest, SaysWhatAReplayMisses) {
  read(
      "feature_tracker: {use_mask: true}\n"
      "simulator: {wrench_frame: world}\n");
  ASSERT_EQ(warnings_.size(), 2u);
  for (const std::string& warning : warnings_) EXPECT_TRUE(says(warning, "has no effect in a replay"));
}

TEST_F(GraphConfigTest, ReadsTheSurroundings) {
  const SurroundingsConfig surroundings =
      read(
          "simulator: {obstacles: [{name: table, shape: plane, frame: /world}], gripper: hand, "
          "pin_accuracy_m: 0.003}\n")
          .pipeline.surroundings;
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  ASSERT_EQ(surroundings.obstacles.size(), 1u);
  EXPECT_EQ(surroundings.obstacles.front().frame, "world");
  EXPECT_EQ(surroundings.gripper->frame, "hand");
  EXPECT_EQ(surroundings.gripper_closed, "/gripper/closed");
  EXPECT_EQ(surroundings.pin_accuracy_m, 0.003);
  read("simulator: {obstacles: [{name: table, shape: plane, colour: red}]}\n");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_TRUE(says(warnings_.front(), "colour"));
}

TEST_F(GraphConfigTest, AnotherGripperReplacesThatOfTheParameters) {
  std::ofstream(path_) << "simulator: {gripper: hand}\n"
                          "tool_tracker: {blade_frame: tool0}\n";
  EXPECT_EQ(readGraphConfig(path_, &warnings_).pipeline.surroundings.gripper->frame, "hand");
  const GraphConfig config = readGraphConfig(path_, &warnings_, "/claw");
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  EXPECT_EQ(config.pipeline.surroundings.gripper->frame, "claw");
  EXPECT_EQ(config.blade_frame, "tool0");
}

TEST_F(GraphConfigTest, RefusesWhatTheNodeRefuses) {
  EXPECT_TRUE(says(refusalOf("camera_ingest: {sync_tolerance_s: -1}\n"), "sync_tolerance_s is -1"));
  EXPECT_EQ(read("camera_ingest: {sync_tolerance_s: 0.02}\n").pairing.tolerance, 20'000'000);
}

}  // namespace
}  // namespace softbody
