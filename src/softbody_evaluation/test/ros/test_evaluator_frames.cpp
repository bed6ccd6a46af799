#include <fmt/format.h>
#include <fmt/ranges.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <test_support/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fixtures/evaluator_bags.h"

namespace softbody::evaluation {
namespace {

TEST(Evaluator, AResultInAnotherFrameIsBroughtBackByTf) {
  EvaluatorOptions options;
  const Eigen::Vector3d offset(0.5, -0.25, 2.0);
  // world = camera turned by a quarter about z, then moved.
  options.result = resultFromTruth("in_world.bag", [&](softbody_msgs::MeshState* s, int) {
    for (geometry_msgs::Point32& p : s->vertices) {
      const geometry_msgs::Point32 camera = p;
      p.x = static_cast<float>(offset.x() - camera.y);
      p.y = static_cast<float>(offset.y() + camera.x);
      p.z = static_cast<float>(offset.z() + camera.z);
    }
    s->header.frame_id = "world";
    return true;
  });
  options.truth = recording();
  const std::string way = "static_transform_publisher 0 0 0 0 0 0 world camera_color_optical_frame";
  EXPECT_TRUE(says(failure(options), way));
  EXPECT_FALSE(says(failure(options), ".."));
  {
    rosbag::Bag bag(options.result, rosbag::bagmode::Append);
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    geometry_msgs::TransformStamped& t = message.transforms[0];
    t.header.frame_id = "world";
    t.header.stamp = ros::Time(1.0);
    t.child_frame_id = "camera_color_optical_frame";
    t.transform.translation.x = offset.x();
    t.transform.translation.y = offset.y();
    t.transform.translation.z = offset.z();
    t.transform.rotation.z = t.transform.rotation.w = std::sqrt(0.5);
    bag.write("/tf_static", ros::Time(1.6e9), message);
  }
  const Report report = evaluate(options);
  EXPECT_EQ(report.frames.answered, static_cast<std::size_t>(kFrames));
  EXPECT_LT(report.vertex_error->all.max, 1e-6);
  EXPECT_TRUE(report.notes.empty());
}

/// Before a camera that moves, whose place is only known up to the middle.
std::string halfPlacedRecording() {
  virtual_camera::CameraSetup setup = smallSetup();
  setup.camera_motion = "orbit";
  virtual_camera::VirtualCamera camera = makeCamera(setup);
  const std::string whole = testing::TempDir() + "evaluator_moving.bag", half = whole + "_half.bag";
  writeBag(&camera, {whole, kFrames, 4.0}, [](int) {});
  const rosbag::Bag in(whole);
  rosbag::Bag out(half, rosbag::bagmode::Write);
  int transforms = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(in)) {
    if (message.getTopic() == "/tf" && ++transforms > kFrames / 2) continue;
    out.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
  }
  return half;
}

TEST(Evaluator, StatesThatTfDoesNotPlaceAreSaidOfTruthAndUnhiddenBodyToo) {
  EvaluatorOptions options;
  options.truth = halfPlacedRecording();
  options.result = resultFromTruth("moving.bag", asItIs, options.truth);
  options.unhidden = resultFromTruth(
      "moving_unhidden.bag",
      [](softbody_msgs::MeshState* s, int) {
        s->header.frame_id = "camera_color_optical_frame";
        return true;
      },
      options.truth);
  const std::vector<std::string> notes = evaluate(options).notes;
  for (const char* words :
       {"10 of 20 states have no transform", "10 of 20 states of the truth have no transform",
        "10 of 20 states of the unhidden body have no transform"}) {
    const auto says = [&](const std::string& note) { return note.find(words) != std::string::npos; };
    EXPECT_EQ(std::count_if(notes.begin(), notes.end(), says), 1)
        << words << "\n"
        << fmt::format("{}", fmt::join(notes, "\n"));
  }
}

TEST(Evaluator, ThePoseOfTheToolIsComparedWhereTheTruthHasOne) {
  EvaluatorOptions options;
  options.result = resultFromTruth("tool.bag", asItIs);
  options.truth = testing::TempDir() + "tool_truth.bag";
  std::filesystem::copy_file(recording(), options.truth, std::filesystem::copy_options::overwrite_existing);
  rosbag::Bag result(options.result, rosbag::bagmode::Append), truth(options.truth, rosbag::bagmode::Append);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.pose.pose.orientation.w = 1.0;
  for (int k = 0; k < 5; ++k) {
    pose.header.stamp = ros::Time(1.6e9 + k);
    pose.pose.pose.position.x = 0.0;
    truth.write("/ground_truth/tool/pose", pose.header.stamp, pose);
    pose.pose.pose.position.x = 0.002;
    if (k > 0) result.write("/softbody/tool/pose", pose.header.stamp, pose);
  }
  result.close();
  truth.close();
  const Report report = evaluate(options);
  EXPECT_EQ(report.tool->expected, 5u);
  EXPECT_EQ(report.tool->answered, 4u);
  EXPECT_NEAR(report.tool->position.mean, 0.002, 1e-8);
  EXPECT_TRUE(report.notes.empty());
}

TEST(Evaluator, PosesOfTheToolThatTfDoesNotPlaceAreSaid) {
  EvaluatorOptions options;
  options.result = resultFromTruth("lost_tool.bag", asItIs);
  options.truth = testing::TempDir() + "lost_tool_truth.bag";
  std::filesystem::copy_file(recording(), options.truth, std::filesystem::copy_options::overwrite_existing);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header.stamp = ros::Time(1.6e9);
  pose.pose.pose.orientation.w = 1.0;
  for (const std::string& path : {options.truth, options.result}) {
    pose.header.frame_id = path == options.truth ? "camera_color_optical_frame" : "nowhere";
    rosbag::Bag(path, rosbag::bagmode::Append)
        .write(path == options.truth ? "/ground_truth/tool/pose" : "/softbody/tool/pose", pose.header.stamp,
               pose);
  }
  const Report report = evaluate(options);
  EXPECT_EQ(report.tool->answered, 0u);
  ASSERT_EQ(report.notes.size(), 1u);
  EXPECT_TRUE(says(report.notes[0], "1 of 1 poses of the tool"));
}

}  // namespace
}  // namespace softbody::evaluation
