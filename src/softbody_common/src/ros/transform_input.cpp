#include "softbody_common/ros/transform_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

constexpr int kQueue = 100;                                      // as tf2_ros
constexpr std::size_t kMostFrames = 10'000, kLongestName = 256;  // tf2 never forgets a frame
constexpr char kAuthority[] = "tf";

}  // namespace

TransformInput::TransformInput() : spinner_(1, &queue_) {
  buffer_.setUsingDedicatedThread(true);
  node_.setCallbackQueue(&queue_);
  moving_ =
      node_.subscribe("/tf", kQueue, &TransformInput::onMoving, this, ros::TransportHints().tcpNoDelay());
  fixed_ = node_.subscribe<tf2_msgs::TFMessage>("/tf_static", kQueue, [this](const auto& message) {
    for (const auto& transform : message->transforms) add(transform, true);
  });
  spinner_.start();
}

void TransformInput::claim(const std::string& frame) {
  const std::lock_guard lock(claim_mutex_);
  claimed_ = frame;
}

void TransformInput::onMoving(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  std::string own;
  {
    const std::lock_guard lock(claim_mutex_);
    own = claimed_;
  }
  const std::string& sender = event.getPublisherName();
  for (const auto& transform : event.getMessage()->transforms) {
    if (!own.empty() && sender != ros::this_node::getName() && withoutSlash(transform.child_frame_id) == own)
      ROS_WARN_STREAM_THROTTLE(
          60.0,
          fmt::format("the frame '{}' on /tf is sent by this node and by {}: whoever reads it sees both. "
                      "Stop one of them, or give it another frame (namespace:= of the launch file, or "
                      "the parameter body_frame or tool_frame)",
                      own, sender));
    add(transform, false);
  }
}

void TransformInput::add(const geometry_msgs::TransformStamped& transform, bool is_fixed) try {
  admit(transform.header.frame_id);
  admit(transform.child_frame_id);
  if (is_fixed || isNew(transform)) buffer_.setTransform(transform, kAuthority, is_fixed);
} catch (const std::exception& error) {
  warnOfRefused(transform.child_frame_id, error.what());
}

void TransformInput::warnOfRefused(const std::string& frame, const std::string& why) {
  ROS_WARN_STREAM_THROTTLE(5.0,
                           "the transform of '" << frame.substr(0, kLongestName) << "' is not used: " << why);
}

/// The frame at the end of the chain of parents. @param frame that tf knows.
std::string TransformInput::rootOf(std::string frame) const {
  std::string parent;
  for (std::size_t i = 0; i < kMostFrames && buffer_._getParent(frame, ros::Time(), parent); ++i)
    frame = parent;
  return frame;
}

std::string TransformInput::whyMissing(const std::string& target, const std::string& source) const {
  if (buffer_.canTransform(target, source, ros::Time())) return {};
  for (const std::string& frame : {source, target}) {
    if (buffer_._frameExists(frame)) continue;
    std::vector<std::string> known;
    buffer_._getFrameStrings(known);
    return fmt::format(
        "tf does not know the frame '{}'. It knows {}. Start what publishes the frame on /tf or "
        "/tf_static, for example the camera's driver or static_transform_publisher",
        frame, known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
  }
  return fmt::format(
      "the frames '{}' and '{}' are not connected in tf: the transform between '{}' and '{}' is "
      "missing on /tf or /tf_static",
      source, target, rootOf(source), rootOf(target));
}

/// Frames are bounded, because any sender can name new ones. @throw std::length_error
void TransformInput::admit(const std::string& frame) {
  if (frames_.count(frame) > 0) return;
  if (frame.size() > kLongestName)
    throw std::length_error(
        fmt::format("a frame's name has {} characters; allowed: up to {}", frame.size(), kLongestName));
  if (frames_.size() >= kMostFrames)
    throw std::length_error(fmt::format(
        "tf has {} frames, which is the limit; find the sender of new names, and start this node again",
        kMostFrames));
  frames_.insert(frame);
}

/// A bag that loops, or a publisher that is faster than its sensor, repeats transforms: no warning for that.
/// tf2 itself says what is late.
bool TransformInput::isNew(const geometry_msgs::TransformStamped& transform) {
  Child& child = children_[transform.child_frame_id];
  const StampVerdict verdict =
      child.timeline.judge(toNanoseconds(transform.header.stamp), toNanoseconds(ros::Time::now()));
  const auto refused = child.refused.note(toNanoseconds(transform.header.stamp), verdict);
  const auto isWrong = [](StampVerdict::Kind kind) {
    return kind == StampVerdict::kUnstamped || kind == StampVerdict::kOutlier;
  };
  if (refused && isWrong(refused->verdict.kind))
    warnOfRefused(transform.child_frame_id, whyRefused(refused->verdict));
  if (isWrong(verdict.kind)) return false;
  // tf2 refuses everything before the newest transform of a child that it has. When a bag starts again, the
  // first child that goes back clears the buffer for all.
  if (verdict.wentBack() && child.clears == clears_) {
    ++clears_;
    buffer_.clear();
  }
  if (verdict.accepted()) child.clears = clears_;
  return verdict.kind != StampVerdict::kRepeated;
}

}  // namespace softbody
