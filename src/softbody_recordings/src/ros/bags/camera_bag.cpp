#include "ros/bags/camera_bag.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_msgs/TFMessage.h>

#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr char kFrame[] = "camera_color_optical_frame";

}  // namespace

CameraBag::CameraBag(const std::filesystem::path& output, sensor_msgs::CameraInfo info)
    : info_(std::move(info)), bag_(output) {}

void CameraBag::writeOpticalFrame(Nanoseconds stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = toTime(stamp);
  transform.header.frame_id = "camera_link";
  transform.child_frame_id = kFrame;
  transform.transform.rotation.x = -0.5;
  transform.transform.rotation.y = 0.5;
  transform.transform.rotation.z = -0.5;
  transform.transform.rotation.w = 0.5;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  bag_.writeLatched("/tf_static", toTime(stamp), message);
}

void CameraBag::writeColor(Nanoseconds stamp, const cv::Mat3b& bgr) {
  writeImage("/camera/color/", stamp, bgr, sensor_msgs::image_encodings::BGR8.c_str());
}

void CameraBag::writeDepth(Nanoseconds stamp, const cv::Mat& depth) {
  const bool metres = depth.type() == CV_32FC1;
  writeImage(
      "/camera/aligned_depth_to_color/", stamp, depth,
      (metres ? sensor_msgs::image_encodings::TYPE_32FC1 : sensor_msgs::image_encodings::TYPE_16UC1).c_str());
}

void CameraBag::writeImage(const std::string& topics, Nanoseconds stamp, const cv::Mat& image,
                           const char* encoding) {
  std_msgs::Header header;
  header.stamp = toTime(stamp);
  header.frame_id = kFrame;
  info_.header = header;
  bag_.write(topics + "camera_info", header.stamp, info_);
  bag_.write(topics + "image_raw", header.stamp, *cv_bridge::CvImage(header, encoding, image).toImageMsg());
}

}  // namespace softbody
