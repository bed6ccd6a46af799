#include "nodes/feature_tracker/mask_input.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"

namespace softbody {
namespace {

constexpr int kMaskQueue = 10;
constexpr double kLookForLate_s = 0.01;

}  // namespace

cv::Mat1f masked(const cv::Mat1f& depth, const cv::Mat1b& mask) {
  if (mask.size() != depth.size()) {
    throw std::invalid_argument("the mask is " + std::to_string(mask.cols) + "x" + std::to_string(mask.rows) +
                                ", the rectified image " + std::to_string(depth.cols) + "x" +
                                std::to_string(depth.rows));
  }
  cv::Mat1f result(depth.size(), 0.0f);
  depth.copyTo(result, mask);
  return result;
}

MaskInput::MaskInput(ros::NodeHandle handle, double timeout_s, Callback callback)
    : callback_(std::move(callback)), timeout_s_(timeout_s), queue_(timeout_s) {
  subscriber_ = handle.subscribe(topics::kMask, kMaskQueue, &MaskInput::onMask, this);
  timer_ = handle.createWallTimer(ros::WallDuration(kLookForLate_s),
                                  [this](const ros::WallTimerEvent&) { pass(); });
}

void MaskInput::add(const RectifiedImages& images) {
  queue_.addFrame(toNanoseconds(images.color->header.stamp), images, ros::WallTime::now().toSec());
  pass();
}

void MaskInput::onMask(const sensor_msgs::ImageConstPtr& message) try {
  // Copied: what has come may be kept for longer than its message.
  const cv::Mat1b mask = cv_bridge::toCvCopy(message, sensor_msgs::image_encodings::MONO8)->image;
  queue_.addMask(toNanoseconds(message->header.stamp), mask);
  pass();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, subscriber_.getTopic() << " is unusable: " << error.what());
}

void MaskInput::pass() {
  while (const auto ready = queue_.ready(ros::WallTime::now().toSec())) {
    if (!ready->mask) {
      ROS_WARN_STREAM_THROTTLE(5.0, "frame " << ready->frame.color->header.stamp << ": no mask on "
                                             << subscriber_.getTopic() << " within " << timeout_s_
                                             << " s, or only that of a later frame; tracked without");
    }
    callback_(ready->frame, ready->mask.value_or(cv::Mat1b()));
  }
}

}  // namespace softbody
