#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "softbody_common/ros/frame_name.h"
#include "softbody_tracking/camera/point_cloud.h"
#include "softbody_tracking/rgbd_frame.h"

/// Conversions between camera messages and the core. All throw std::invalid_argument for malformed messages,
/// with a sentence that says what is wrong.
namespace softbody {

/// The image as BGR in its own memory, from any colour encoding that cv_bridge knows; without names of the
/// colours (8UC3, 8UC4) as BGR and BGRA; grey is refused.
cv::Mat3b colorFromMessage(const sensor_msgs::Image& image);

/// The image as CV_16UC1 [mm] or CV_32FC1 [m]. It may share the message's memory, so the message must outlive
/// it.
cv::Mat depthFromMessage(const sensor_msgs::Image& image);

/// A frame of rectified images of one size (depth 32FC1 [m]), with an identity T_fixed_camera. Depth below 0
/// and beyond 100 m becomes 0. The frame may share the messages' memory, so they must outlive it, and nobody
/// may write into it.
RgbdFrame frameFromRectified(const sensor_msgs::Image& color, const sensor_msgs::Image& depth,
                             const sensor_msgs::CameraInfo& info);

/// The mask in its own memory: grey, 0 where nothing counts.
cv::Mat1b maskFromMessage(const sensor_msgs::Image& image);

/// Whether a colour image can be handed on to those who read it with frameFromRectified, as it is: bgr8 or
/// rgb8. @throw std::invalid_argument if its size and its number of bytes do not fit together.
bool isUsualColor(const sensor_msgs::Image& image);

/// CV_8UC3 becomes bgr8, CV_32FC1 becomes 32FC1.
sensor_msgs::ImagePtr toMessage(const cv::Mat& image, const std_msgs::Header& header);

/// A cloud with the fields x y z [m] and rgb (float32, packed as by PCL). @param width 0: an unorganised
/// cloud.
sensor_msgs::PointCloud2Ptr toMessage(const std::vector<ColoredPoint>& points, int width,
                                      const std_msgs::Header& header);

}  // namespace softbody
