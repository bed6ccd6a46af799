#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/point_cloud.h"

/// Between camera messages and the core. Malformed messages are refused with std::invalid_argument, in a
/// sentence.
namespace softbody {

/// BGR in memory of its own; from any colour or grey encoding that cv_bridge knows.
cv::Mat3b colorFromMessage(const sensor_msgs::Image& image);

/// CV_16UC1 [mm] or CV_32FC1 [m]; shares the message's memory where it can, so the message must outlive it.
cv::Mat depthFromMessage(const sensor_msgs::Image& image);

Distortion distortionFromMessage(const sensor_msgs::CameraInfo& info);

/// A whole frame: colour, depth registered to it (nullptr: none came) and the colour camera's info. Stamp:
/// the colour's.
RgbdFrame frameFromMessages(const sensor_msgs::Image& color, const sensor_msgs::Image* depth,
                            const sensor_msgs::CameraInfo& info, CameraIngest* ingest);

/// A frame's name for tf2, which refuses the leading slash of old drivers and bags.
std::string withoutSlash(const std::string& frame);

/// CV_8UC3 becomes bgr8, CV_32FC1 32FC1.
sensor_msgs::ImagePtr toMessage(const cv::Mat& image, const std_msgs::Header& header);

/// Fields x y z [m] and rgb (float32, packed as PCL does). @param width 0: an unorganised cloud.
sensor_msgs::PointCloud2Ptr toMessage(const std::vector<ColoredPoint>& points, int width,
                                      const std_msgs::Header& header);

}  // namespace softbody
