#include "softbody_common/ros/transform_input.h"

#include <fmt/format.h>

#include <stdexcept>

#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

constexpr int kQueue = 100;  // as tf2_ros
constexpr std::size_t kMostFrames = 10'000;
constexpr char kAuthority[] = "tf";

}  // namespace

TransformInput::TransformInput() : spinner_(1, &queue_) {
  buffer_.setUsingDedicatedThread(true);
  node_.setCallbackQueue(&queue_);
  moving_ = node_.subscribe<tf2_msgs::TFMessage>("/tf", kQueue, [this](const auto& message) {
    for (const auto& transform : message->transforms) add(transform);
  });
  fixed_ = node_.subscribe<tf2_msgs::TFMessage>("/tf_static", kQueue, [this](const auto& message) {
    for (const auto& transform : message->transforms) buffer_.setTransform(transform, kAuthority, true);
  });
  spinner_.start();
}

void TransformInput::add(const geometry_msgs::TransformStamped& transform) try {
  if (isNew(transform)) buffer_.setTransform(transform, kAuthority);
} catch (const std::exception& error) {
  ROS_WARN_STREAM_THROTTLE(
      5.0, "the transform of '" << transform.child_frame_id << "' is not used: " << error.what());
}

/// A bag that loops, or a publisher that is faster than its sensor, repeats transforms: no warning for that.
/// tf2 itself says what is late. @throw std::exception if the stamp is refused.
bool TransformInput::isNew(const geometry_msgs::TransformStamped& transform) {
  const std::string& child = transform.child_frame_id;
  if (timelines_.size() >= kMostFrames && timelines_.count(child) == 0)
    throw std::length_error(fmt::format("tf has {} frames already", kMostFrames));
  Timeline& timeline = timelines_[child];
  const StampVerdict verdict =
      timeline.judge(toNanoseconds(transform.header.stamp), toNanoseconds(ros::Time::now()));
  if (verdict.kind == StampVerdict::kUnstamped || verdict.kind == StampVerdict::kOutlier)
    throw std::invalid_argument(whyRefused(verdict));
  // tf2 refuses everything before the newest transform that it has.
  const bool returns = verdict.kind == StampVerdict::kMoved && verdict.wentBack();
  if (timeline.pass() > pass_ || returns) {
    pass_ = timeline.pass();
    buffer_.clear();
  }
  return verdict.kind != StampVerdict::kRepeated;
}

}  // namespace softbody
