#include <geometry_msgs/WrenchStamped.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TrackingStatus.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "replay/recordings.h"
#include "softbody_evaluation/ros/evaluator.h"
#include "softbody_recordings/ros/replay.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr double kWeight = 0.2 * 0.1 * 0.04 * 30.0 * 9.81;  // of the sponge [N]

/// Recordings that are replayed with pins, a gripper or obstacles.
class ReplayedSurroundings : public ::testing::Test {
 protected:
  ReplayedSurroundings() {
    for (const char* mesh : {"sponge.obj", "sponge_cage.obj", "sponge_tets.vtu"})
      fs::copy_file(fs::path(CONFIG_DIR) / mesh, folder_ / mesh);
  }

  /// The sponge with pins.
  std::string sponge(const std::string& pins) const {
    return folder_.write(
        "sponge.yaml",
        "object:\n  visual_mesh: sponge.obj\n  cage_mesh: sponge_cage.obj\n"
        "  tet_mesh: sponge_tets.vtu\n  material: {youngs_modulus_pa: 2.0e4, poisson_ratio: 0.2, "
        "density_kg_m3: 30, damping: 0.1}\n"
        "  initial_pose: [0.006, -0.005, 0.506, 0.8959, -0.2102, 0.0572, 0.3873]\n  pins: [" +
            pins + "]\n");
  }
  BodySummary run(ReplayOptions options) {
    options.output = folder_ / "result.bag";
    warnings_.clear();
    return replay(
               options, [this](const std::string& warning) { warnings_.push_back(warning); }, [](double) {})
        .bodies.front();
  }
  template <typename Message>
  std::vector<Message> results(const std::string& topic) const {
    return test::messagesOf<Message>(folder_ / "result.bag", topic);
  }
  int warningsWith(const std::string& words) const {
    return static_cast<int>(
        std::count_if(warnings_.begin(), warnings_.end(),
                      [&](const std::string& warning) { return warning.find(words) != std::string::npos; }));
  }

  const test::ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(ReplayedSurroundings, AGripperSaysWhereTheHiddenEndIs) {
  const std::string recording = folder_ / "grasp.bag";
  test::record("grasp", recording, 48, 15.0);
  ReplayOptions options;
  options.input = recording;
  options.objects = {CONFIG_DIR "/sponge.yaml"};
  const auto hidden_mean = [&] {
    run(options);
    evaluation::EvaluatorOptions of;
    of.result = folder_ / "result.bag";
    of.truth = recording;
    return evaluation::evaluate(of).vertex_error->hidden.mean;
  };
  const double alone = hidden_mean();
  EXPECT_TRUE(results<geometry_msgs::WrenchStamped>("/softbody/reaction/gripper").empty());
  options.gripper = CONFIG_DIR "/gripper.yaml";
  EXPECT_LT(hidden_mean(), alone);
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  const auto felt = results<geometry_msgs::WrenchStamped>("/softbody/reaction/gripper");
  ASSERT_FALSE(felt.empty());
  EXPECT_EQ(felt.front().header.frame_id, "gripper");
  EXPECT_FALSE(results<geometry_msgs::WrenchStamped>("/softbody/reaction/gripper_finger_2").empty());
  options.gripper = folder_.write("gripper.yaml", "gripper: {frame: gripper, closed: /somebody/else}\n");
  run(options);
  EXPECT_EQ(warningsWith("the gripper never closes"), 1);
}

TEST_F(ReplayedSurroundings, PinsCarryTheWeightOfAStillBody) {
  ReplayOptions options;
  options.input = ROSBAGS_DIR "/bend_small.bag";
  options.objects = {sponge("{name: all, min: [-1, -1, -1], max: [1, 1, 1]}")};
  options.parameters = folder_.write("parameters.yaml", "simulator: {gravity_m_s2: [0, 9.81, 0]}\n");
  run(options);
  const auto felt = results<geometry_msgs::WrenchStamped>("/softbody/reaction/all");
  ASSERT_GT(felt.size(), 5U);
  EXPECT_EQ(felt[2].header.frame_id, "camera_color_optical_frame");
  EXPECT_NEAR(felt[2].wrench.force.x, 0.0, 0.05 * kWeight);
  EXPECT_NEAR(felt[2].wrench.force.y, kWeight, 0.05 * kWeight);
  EXPECT_NEAR(felt[2].wrench.force.z, 0.0, 0.05 * kWeight);
  for (std::size_t k = 1; k < felt.size(); ++k)  // one for each estimate, with its stamp
    EXPECT_GE((felt[k].header.stamp - felt[k - 1].header.stamp).toSec(), 0.199);
}

TEST_F(ReplayedSurroundings, AnUnknownFrameIsSaidAndChangesNothing) {
  ReplayOptions options;
  options.input = ROSBAGS_DIR "/bend_small.bag";
  options.objects = {sponge("")};
  run(options);
  const auto without = results<softbody_msgs::MeshState>("/softbody/surface/state");
  options.objects = {sponge("{name: end, frame: nowhere, min: [0.05, -1, -1], max: [1, 1, 1]}")};
  run(options);
  EXPECT_EQ(warningsWith("waiting for frame 'nowhere': tf does not know it"), 1);
  EXPECT_TRUE(results<softbody_msgs::MeshState>("/softbody/surface/state") == without);
}

TEST_F(ReplayedSurroundings, AnOpenLoopGoesOnFromTheLastImage) {
  ReplayOptions options;
  options.input = ROSBAGS_DIR "/bend_small.bag";
  options.objects = {sponge("")};
  run(options);
  const auto tracked = results<softbody_msgs::MeshState>("/softbody/surface/state");
  options.open_loop = 0.2;
  EXPECT_EQ(run(options).predicted, 9);
  const auto states = results<softbody_msgs::MeshState>("/softbody/surface/state");
  ASSERT_EQ(states.size(), tracked.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_EQ(states[k].header.stamp, tracked[k].header.stamp);
    EXPECT_EQ(states[k].observed, tracked[std::min<std::size_t>(k, 35)].observed);
    EXPECT_EQ(states[k] == tracked[k], k < 36) << k;
  }
  EXPECT_EQ(results<softbody_msgs::Targets>("/softbody/targets").size(), 36U);
  EXPECT_EQ(results<softbody_msgs::TrackingStatus>("/softbody/status").size(), 36U);
}

TEST_F(ReplayedSurroundings, APinThatHoldsNothingIsRefused) {
  ReplayOptions options;
  options.input = ROSBAGS_DIR "/bend_small.bag";
  options.objects = {sponge("{name: end, min: [2, -1, -1], max: [3, 1, 1]}")};
  EXPECT_TRUE(says(complaint([&] { run(options); }), "'end' contains nothing"));
}

TEST_F(ReplayedSurroundings, ACutThroughAPinnedRegionIsMade) {
  ReplayOptions options;
  options.input = ROSBAGS_DIR "/cut_small.bag";
  options.objects = {sponge("{name: end, min: [-1, -1, -1], max: [1, 1, 1]}")};
  options.tool = CONFIG_DIR "/knife.yaml";
  const BodySummary summary = run(options);
  EXPECT_GT(summary.cuts, 0);
  EXPECT_EQ(summary.pieces, 2U);
  EXPECT_EQ(summary.failed, 0);
  EXPECT_GE(3 * static_cast<int>(results<geometry_msgs::WrenchStamped>("/softbody/reaction/end").size()),
            summary.states - 1);  // five a second of ten frames
}

}  // namespace
}  // namespace softbody
