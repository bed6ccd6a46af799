#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <opencv2/core.hpp>

#include "camera/mask_queue.h"
#include "nodes/rectified_input.h"

namespace softbody {

/// Depth where the mask is not zero, 0 elsewhere. @throw std::invalid_argument if the sizes differ.
cv::Mat1f masked(const cv::Mat1f& depth, const cv::Mat1b& mask);

/// Holds frames until the user's segmentation has sent their masks on the topic `mask`, and warns of those
/// that go without.
class MaskInput {
 public:
  /// @param mask empty where none came in time.
  using Callback = std::function<void(const RectifiedImages& images, const cv::Mat1b& mask)>;

  MaskInput(ros::NodeHandle handle, double timeout_s, Callback callback);
  void add(const RectifiedImages& images);

 private:
  void onMask(const sensor_msgs::ImageConstPtr& message);
  void pass();

  Callback callback_;
  double timeout_s_;
  MaskQueue<RectifiedImages, cv::Mat1b> queue_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
};

}  // namespace softbody
