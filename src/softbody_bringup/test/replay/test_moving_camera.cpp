#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/TrackingStatus.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "replay/recordings.h"
#include "softbody_evaluation/ros/evaluator.h"
#include "softbody_recordings/ros/replay.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

/// A sponge at rest before a small virtual camera that moves.
class MovingCamera : public ::testing::Test {
 protected:
  static constexpr int kFrames = 45;

  static void SetUpTestSuite() { record("still", "moving.bag"); }
  static void record(const std::string& scene, const std::string& name) {
    test::record(scene, folder_ / name, kFrames, 30.0, "orbit");
  }

  /// The recording without /tf from frame `first` to before `last`.
  static std::string withoutTf(const std::string& name, int first, int last,
                               const std::string& of = "moving.bag") {
    const std::string path = folder_ / name;
    const rosbag::Bag whole(folder_ / of);
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    int frame = -1;
    for (const rosbag::MessageInstance& message : rosbag::View(whole)) {
      const bool tf = message.getTopic() == "/tf";
      if (tf) ++frame;
      if (tf && frame >= first && frame < last) continue;
      bag.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
    }
    return path;
  }

  static BodySummary run(const std::string& input, const std::string& output, const std::string& tool = "") {
    ReplayOptions options;
    options.input = input;
    options.objects = {CONFIG_DIR "/sponge.yaml"};
    options.output = folder_ / output;
    options.tool = tool;
    options.output_frame = "world";
    warnings_.clear();
    return replay(
               options, [](const std::string& warning) { warnings_.push_back(warning); }, [](double) {})
        .bodies.front();
  }

  static evaluation::Report measure(const std::string& result) {
    evaluation::EvaluatorOptions options;
    options.result = folder_ / result;
    options.truth = folder_ / "moving.bag";
    return evaluation::evaluate(options);
  }

  static inline const test::ScratchFolder folder_;
  static std::vector<std::string> warnings_;  ///< of the last run
};

std::vector<std::string> MovingCamera::warnings_;

TEST_F(MovingCamera, ABodyAtRestIsAtRestInTheWorld) {
  const BodySummary summary = run(folder_ / "moving.bag", "world.bag");
  EXPECT_EQ(summary.states, kFrames);
  EXPECT_EQ(summary.skipped, 0);
  const evaluation::Report report = measure("world.bag");
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames));
  EXPECT_LT(report.vertex_error->all.mean, 0.0015);
  ASSERT_TRUE(report.jitter);
  // What is compared with the images goes through the camera's frame.
  ASSERT_TRUE(report.silhouette);
  EXPECT_GT(report.silhouette->mean, 0.95);
}

TEST_F(MovingCamera, FramesWithoutTfAreLeftOutWithTheReason) {
  const BodySummary gap = run(withoutTf("gap.bag", 20, 36), "gap_result.bag");
  EXPECT_EQ(gap.skipped, 16);
  EXPECT_EQ(gap.states, kFrames - 16);
  EXPECT_EQ(gap.frames_by_state.at(TrackingState::kDegraded), 16) << "after the gap it is tracked at once";
  EXPECT_LT(measure("gap_result.bag").vertex_error->all.mean, 0.0015);
  // The straight way over a short gap is good enough.
  EXPECT_EQ(run(withoutTf("short.bag", 20, 24), "short_result.bag").skipped, 0);
  const BodySummary cut_off = run(withoutTf("end.bag", 20, kFrames), "end_result.bag");
  EXPECT_EQ(cut_off.skipped, kFrames - 20);
  const std::string& reason = cut_off.reasons.at(TrackingState::kDegraded);
  EXPECT_TRUE(says(reason, "camera_color_optical_frame is in output_frame world"));
  const rosbag::Bag bag(folder_ / "end_result.bag");
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("/softbody/status")).size(), static_cast<unsigned>(kFrames));
}

TEST_F(MovingCamera, TheToolIsSeenWithoutTfToo) {
  record("cut", "knife.bag");
  const std::string knife = CONFIG_DIR "/knife.yaml";
  const int with_tf = run(folder_ / "knife.bag", "knife_result.bag", knife).tools;
  EXPECT_GT(with_tf, kFrames / 2);
  const BodySummary gap = run(withoutTf("knife_gap.bag", 20, 36, "knife.bag"), "knife_gap_result.bag", knife);
  EXPECT_EQ(gap.skipped, 16);
  EXPECT_GE(gap.tools, with_tf - 1);
}

TEST_F(MovingCamera, TfThatNeverComesIsAnError) {
  const std::string input = withoutTf("none.bag", 0, kFrames);
  tf2_msgs::TFMessage unusable;
  unusable.transforms.resize(1);
  unusable.transforms[0].header.frame_id = "world";
  unusable.transforms[0].child_frame_id = "camera_color_optical_frame";
  rosbag::Bag(input, rosbag::bagmode::Append).write("/tf_static", ros::Time(1.6e9), unusable);
  EXPECT_TRUE(
      says(complaint<std::runtime_error>([&] { run(input, "none_result.bag"); }), "tf does not say where"));
  EXPECT_FALSE(fs::exists(folder_ / "none_result.bag"));
  const auto said = std::find_if(warnings_.begin(), warnings_.end(), [](const std::string& warning) {
    return warning.find("1 transform of frame 'camera_color_optical_frame' left out") != std::string::npos;
  });
  EXPECT_NE(said, warnings_.end());
}

}  // namespace
}  // namespace softbody
