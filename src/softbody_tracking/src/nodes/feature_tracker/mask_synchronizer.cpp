#include "nodes/feature_tracker/mask_synchronizer.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr int kMaskQueue = 10;           // masks: a segmentation of several frames sends them at once
constexpr double kTimerPeriod_s = 0.01;  // [s] between two checks for timeouts; short against a frame's 33 ms

}  // namespace

RgbdFrame masked(const RgbdFrame& frame, const cv::Mat1b& mask) {
  if (mask.size() != frame.depth.size()) {
    throw std::invalid_argument("the mask is " + std::to_string(mask.cols) + "x" + std::to_string(mask.rows) +
                                ", the rectified image " + std::to_string(frame.depth.cols) + "x" +
                                std::to_string(frame.depth.rows));
  }
  RgbdFrame result = frame;
  result.depth = cv::Mat1f(frame.depth.size(), 0.0f);
  frame.depth.copyTo(result.depth, mask);
  result.covered = mask == 0;
  return result;
}

MaskSynchronizer::MaskSynchronizer(ros::NodeHandle handle, double timeout_s, Callback callback)
    : callback_(std::move(callback)), timeout_s_(timeout_s), queue_(timeout_s) {
  subscriber_ = handle.subscribe(topics::kMask, kMaskQueue, &MaskSynchronizer::onMask, this,
                                 ros::TransportHints().tcpNoDelay());
  timer_ = handle.createWallTimer(ros::WallDuration(kTimerPeriod_s),
                                  [this](const ros::WallTimerEvent&) { passReadyFrames(); });
}

void MaskSynchronizer::addFrame(const ReceivedFrame& frame) {
  queue_.addFrame(frame.frame.stamp, frame, ros::WallTime::now().toSec());
  passReadyFrames();
}

void MaskSynchronizer::onMask(const sensor_msgs::ImageConstPtr& message) try {
  queue_.addMask(toNanoseconds(message->header.stamp), maskFromMessage(*message));
  passReadyFrames();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, subscriber_.getTopic() << " is unusable: " << error.what());
}

void MaskSynchronizer::passReadyFrames() {
  while (const auto ready = queue_.ready(ros::WallTime::now().toSec())) {
    if (!ready->mask) {
      ROS_WARN_STREAM_THROTTLE(5.0, "frame " << ready->frame.images.color->header.stamp
                                             << " is tracked without a mask: no mask on "
                                             << subscriber_.getTopic() << " within " << timeout_s_
                                             << " s, or only the mask of a later frame");
    }
    callback_(ready->frame, ready->mask.value_or(cv::Mat1b()));
  }
}

std::unique_ptr<MaskSynchronizer> makeMaskSynchronizer(const ros::NodeHandle& handle,
                                                       const MaskOptions& options,
                                                       MaskSynchronizer::Callback callback) {
  if (!options.use) return nullptr;
  return std::make_unique<MaskSynchronizer>(handle, options.timeout_s, std::move(callback));
}

}  // namespace softbody
