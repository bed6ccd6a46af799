#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <memory>
#include <opencv2/core.hpp>

#include "camera/mask_queue.h"
#include "nodes/rectified_image_subscriber.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {

/// The frame in which something covers all that the mask leaves out: there it has no depth, and its colours
/// say nothing. @param mask not 0: the body. @throw std::invalid_argument if the sizes differ.
RgbdFrame masked(const RgbdFrame& frame, const cv::Mat1b& mask);

/// A frame, and the messages whose memory it shares.
struct ReceivedFrame {
  RectifiedImages images;
  RgbdFrame frame;
};

/// Holds each frame until its segmentation mask arrives on the topic `mask`. Warns about frames without a
/// mask.
class MaskSynchronizer {
 public:
  /// @param mask empty if none arrived in time.
  using Callback = std::function<void(const ReceivedFrame& frame, const cv::Mat1b& mask)>;

  MaskSynchronizer(ros::NodeHandle handle, double timeout_s, Callback callback);
  void addFrame(const ReceivedFrame& frame);
  /// Forgets the frames that wait, for when time has jumped back.
  void forgetFrames() { queue_.forgetFrames(); }

 private:
  void onMask(const sensor_msgs::ImageConstPtr& message);
  void passReadyFrames();

  Callback callback_;
  double timeout_s_;
  MaskQueue<ReceivedFrame, cv::Mat1b> queue_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
};

/// @return nullptr if no masks are used.
std::unique_ptr<MaskSynchronizer> makeMaskSynchronizer(const ros::NodeHandle& handle,
                                                       const MaskOptions& options,
                                                       MaskSynchronizer::Callback callback);

}  // namespace softbody
