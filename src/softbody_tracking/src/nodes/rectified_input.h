#pragma once

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <utility>

#include "softbody_common/topics.h"

namespace softbody {

/// What camera_ingest made of a frame, with one stamp.
struct RectifiedImages {
  sensor_msgs::ImageConstPtr color, depth;
  sensor_msgs::CameraInfoConstPtr info;
};

/// Listens to camera_ingest.
class RectifiedInput {
 public:
  using Callback = std::function<void(const RectifiedImages& images)>;

  RectifiedInput(ros::NodeHandle handle, Callback callback)
      : callback_(std::move(callback)),
        color_(handle, topics::kRgbRect, 1),
        depth_(handle, topics::kDepthRect, 1),
        info_(handle, topics::kRgbInfo, 1),
        synchronizer_(color_, depth_, info_, kQueue) {
    synchronizer_.registerCallback(&RectifiedInput::onImages, this);
  }

 private:
  static constexpr int kQueue = 4;

  void onImages(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth,
                const sensor_msgs::CameraInfoConstPtr& info) {
    callback_({color, depth, info});
  }

  Callback callback_;
  message_filters::Subscriber<sensor_msgs::Image> color_, depth_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::Image, sensor_msgs::CameraInfo>
      synchronizer_;
};

}  // namespace softbody
