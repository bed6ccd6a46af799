#pragma once

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <functional>

#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// One frame from camera_ingest. The three messages have the same stamp.
struct RectifiedImages {
  sensor_msgs::ImageConstPtr color, depth;
  sensor_msgs::CameraInfoConstPtr info;
};

/// The images as a frame whose T_fixed_camera is the identity. The frame may share the messages' memory, so
/// the messages must outlive it. @throw cv_bridge::Exception or std::invalid_argument for malformed messages.
RgbdFrame frameFromImages(const RectifiedImages& images);

/// Receives frames from camera_ingest.
class RectifiedImageSubscriber {
 public:
  using Callback = std::function<void(const RectifiedImages& images)>;

  RectifiedImageSubscriber(ros::NodeHandle handle, Callback callback);

 private:
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
