#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <optional>
#include <string>

#include "camera/frame_assembler.h"
#include "softbody_common/ros/newest_only.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// One frame from camera_ingest. The three messages have the same stamp.
struct RectifiedImages {
  sensor_msgs::ImageConstPtr color, depth;
  sensor_msgs::CameraInfoConstPtr info;
};

/// The images as a frame whose T_fixed_camera is the identity. The frame may share the messages' memory, so
/// the messages must outlive it. @throw std::invalid_argument as frameFromRectified.
RgbdFrame frameFromImages(const RectifiedImages& images);

/// Receives frames from camera_ingest. While the node is busy with a frame, only the newest one waits.
class RectifiedImageSubscriber {
 public:
  using Callback = std::function<void(const RectifiedImages& images)>;

  RectifiedImageSubscriber(ros::NodeHandle handle, Callback callback);
  RectifiedImageSubscriber(const RectifiedImageSubscriber&) = delete;
  RectifiedImageSubscriber& operator=(const RectifiedImageSubscriber&) = delete;

  /// Frames since the start that did not wait.
  int dropped() const { return frames_.dropped(); }
  std::string topic() const { return color_.getTopic(); }
  /// Whether a camera_ingest is connected.
  bool hasPublisher() const { return color_.getNumPublishers() > 0; }

 private:
  using Assembler = FrameAssembler<sensor_msgs::ImageConstPtr, sensor_msgs::CameraInfoConstPtr>;

  void pass(const std::optional<Assembler::Frame>& frame) {
    if (frame) frames_.add({frame->color, frame->depth, frame->info});
  }

  NewestOnly<RectifiedImages> frames_;
  Assembler assembler_;
  // Last, so that callbacks end before the members that they use.
  ros::Subscriber color_, depth_, info_;
};

}  // namespace softbody
