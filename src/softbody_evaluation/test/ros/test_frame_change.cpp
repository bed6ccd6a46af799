#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rosbag/bag.h>
#include <test_support/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/frame_change.h"

namespace softbody::evaluation {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child, int second,
                                          double w = 1.0) {
  geometry_msgs::TransformStamped message;
  message.header.stamp = ros::Time(second, 0);
  message.header.frame_id = parent;
  message.child_frame_id = child;
  message.transform.rotation.w = w;
  return message;
}

std::string bagOf(const std::string& name, const std::vector<geometry_msgs::TransformStamped>& moving,
                  const std::vector<geometry_msgs::TransformStamped>& fixed) {
  const std::string path = testing::TempDir() + name;
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const auto write = [&](const char* topic, const geometry_msgs::TransformStamped& transform) {
    tf2_msgs::TFMessage message;
    message.transforms = {transform};
    bag.write(topic, ros::Time(1, 0), message);
  };
  for (const auto& transform : moving) write("/tf", transform);
  for (const auto& transform : fixed) write("/tf_static", transform);
  return path;
}

/// At 1, 2, 3 s.
SurfaceRecord surface(const std::string& frame_id) {
  SurfaceRecord record;
  record.frame_id = frame_id;
  for (Nanoseconds t = kSecond; t <= 3 * kSecond; t += kSecond)
    record.states[t].vertices = Points::Zero(1, 3);
  return record;
}
ToolRecord tool(const std::string& frame_id) {
  ToolRecord record;
  record.frame_id = frame_id;
  for (Nanoseconds t = kSecond; t <= 3 * kSecond; t += kSecond)
    record.poses[t] = Eigen::Isometry3d::Identity();
  return record;
}

/// Whether each note holds its part, in order.
testing::AssertionResult say(const std::vector<std::string>& notes, const std::vector<std::string>& parts) {
  bool as_expected = notes.size() == parts.size();
  for (std::size_t i = 0; as_expected && i < parts.size(); ++i)
    as_expected = notes[i].find(parts[i]) != std::string::npos;
  return (as_expected ? testing::AssertionSuccess() : testing::AssertionFailure())
         << fmt::format("notes: {}", fmt::join(notes, "\n"));
}

TEST(ExpressIn, WhereNothingIsLeftTheTransformsThatAreRefusedAreNamed) {
  const std::string bag = bagOf("express_refused.bag", {}, {transform("world", "camera", 1, 0.0)});
  SurfaceRecord states = surface("world");
  const std::string said = complaint([&] { expressIn("camera", {bag}, &states); });
  EXPECT_TRUE(say({said}, {"1 transform of frame 'camera' left out"}));
  ToolRecord poses = tool("world");
  expressIn("camera", {bag}, &poses);
  EXPECT_TRUE(poses.poses.empty());
  EXPECT_TRUE(say(poses.notes, {"1 transform of frame 'camera' left out",
                                "3 of 3 poses of the tool have no transform to 'camera'"}));
}

TEST(ExpressIn, WhatHasNoTransformIsCounted) {
  const std::string bag =
      bagOf("express_some.bag", {transform("world", "camera", 1), transform("world", "camera", 2)}, {});
  SurfaceRecord states = surface("world");
  expressIn("camera", {bag}, &states);
  EXPECT_EQ(states.states.size(), 2u);
  EXPECT_TRUE(say(states.notes, {"1 of 3 states have no transform to 'camera'"}));
  ToolRecord poses = tool("world");
  expressIn("camera", {bag}, &poses);
  EXPECT_EQ(poses.poses.size(), 2u);
  EXPECT_TRUE(say(poses.notes, {"1 of 3 poses of the tool have no transform to 'camera'"}));
}

TEST(ExpressIn, NotesComeOnceAndOfFramesOnTheWay) {
  const std::string bag =
      bagOf("express_twice.bag", {transform("world", "camera", 1), transform("world", "camera", 3)},
            {transform("room", "world", 1), transform("room", "world", 1, 0.0),
             transform("world", "camera", 1, 0.5), transform("world", "other", 1, 0.0)});
  SurfaceRecord states = surface("camera");
  for (const char* frame : {"world", "camera", "room"}) expressIn(frame, {bag}, &states);
  EXPECT_TRUE(say(states.notes, {"1 transform of frame 'camera'", "1 transform of frame 'world'"}));
  EXPECT_EQ(states.states.size(), 3u);
}

}  // namespace
}  // namespace softbody::evaluation
