#include "softbody_evaluation/ros/recording_reader.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "ros/typed_topic.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody::evaluation {
namespace {

/// Depth in metres. @throw std::invalid_argument for other encodings.
cv::Mat1f depthInMetres(const sensor_msgs::Image& image) {
  namespace encodings = sensor_msgs::image_encodings;
  const bool millimetres = image.encoding == encodings::TYPE_16UC1 || image.encoding == encodings::MONO16;
  if (!millimetres && image.encoding != encodings::TYPE_32FC1) {
    throw std::invalid_argument(
        fmt::format("a depth image has encoding {}; allowed: 16UC1, 32FC1", image.encoding));
  }
  cv::Mat1f depth;
  cv_bridge::toCvCopy(image)->image.convertTo(depth, CV_32F, millimetres ? 1e-3 : 1.0);
  return depth;
}

/// Removes the lens distortion of a CameraInfo from images.
class Undistortion {
 public:
  explicit Undistortion(const sensor_msgs::CameraInfo& info) : camera(pinholeFromMessage(info)) {
    bool distorted = false;
    for (const double d : info.D) distorted = distorted || d != 0.0;
    if (!distorted) return;
    const cv::Mat K(3, 3, CV_64F, const_cast<double*>(info.K.data())),
        R(3, 3, CV_64F, const_cast<double*>(info.R.data()));
    const cv::Mat new_K =
        (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    const cv::Mat rotation = info.R[0] == 0.0 ? cv::Mat::eye(3, 3, CV_64F) : R;
    cv::initUndistortRectifyMap(K, info.D, rotation, new_K, cv::Size(camera.width, camera.height), CV_32FC1,
                                map_u_, map_v_);
  }

  /// @param interpolation nearest for depth, because depth of two surfaces must not be mixed.
  cv::Mat apply(const cv::Mat& image, int interpolation) const {
    if (map_u_.empty()) return image;
    cv::Mat result;
    cv::remap(image, result, map_u_, map_v_, interpolation);
    return result;
  }

  const Pinhole camera;

 private:
  cv::Mat map_u_, map_v_;
};

using Pairer =
    FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr, sensor_msgs::CameraInfoConstPtr>;

RecordedFrame toFrame(const Pairer::Frame& pair, const Undistortion& undistortion) {
  RecordedFrame frame;
  frame.stamp = pair.stamp;
  frame.frame_id = pair.color->header.frame_id;
  frame.camera = undistortion.camera;
  frame.color = undistortion.apply(cv_bridge::toCvCopy(pair.color, "bgr8")->image, cv::INTER_LINEAR);
  if (pair.depth && (pair.depth->width != pair.color->width || pair.depth->height != pair.color->height))
    throw std::invalid_argument(
        "the recording's depth is not registered to colour, which evaluate needs; record the driver's "
        "registered depth");
  if (pair.depth) frame.depth = undistortion.apply(depthInMetres(*pair.depth), cv::INTER_NEAREST);
  return frame;
}

sensor_msgs::ImageConstPtr imageOf(const rosbag::MessageInstance& instance, const rosbag::Bag& bag) {
  const sensor_msgs::ImageConstPtr image = recordedImage(instance);
  return image ? image : instantiate<sensor_msgs::Image>(instance, bag);
}

sensor_msgs::CameraInfoConstPtr firstInfo(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  return instantiate<sensor_msgs::CameraInfo>(*view.begin(), bag);
}

}  // namespace

void readRecording(const std::string& path, const CameraTopics& camera,
                   const std::function<void(const RecordedFrame&)>& use) try {
  const rosbag::Bag bag = openBag(path);
  const CameraTopics topics = recordedTopics(bag, camera);
  for (const std::string& topic : {topics.color, topics.depth, topics.color_info}) requireTopic(bag, topic);
  const sensor_msgs::CameraInfoConstPtr info = firstInfo(bag, topics.color_info);
  const Undistortion undistortion(*info);
  PairingConfig config;
  config.every_color = true;
  Pairer pairer(config);
  pairer.setInfo(info);
  const auto drain = [&](bool finish) {
    while (const auto pair = pairer.next(finish)) use(toFrame(*pair, undistortion));
  };
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{topics.color, topics.depth}));
  for (const rosbag::MessageInstance& instance : view) {
    const sensor_msgs::ImageConstPtr image = imageOf(instance, bag);
    const Nanoseconds stamp = toNanoseconds(image->header.stamp);
    if (instance.getTopic() == topics.color) {
      pairer.addColor(stamp, image);
    } else {
      pairer.addDepth(stamp, image);
    }
    drain(false);
  }
  drain(true);
} catch (const rosbag::BagException& error) {
  throw damagedBag(path, error);
}

std::string recordingFrame(const std::string& path, const CameraTopics& camera) {
  const rosbag::Bag bag = openBag(path);
  const CameraTopics topics = recordedTopics(bag, camera);
  requireTopic(bag, topics.color);
  rosbag::View view(bag, rosbag::TopicQuery(topics.color));
  return imageOf(*view.begin(), bag)->header.frame_id;
}

bool hasRecording(const std::string& path, const CameraTopics& camera) {
  const rosbag::Bag bag = openBag(path);
  const CameraTopics topics = recordedTopics(bag, camera);
  for (const std::string& topic : {topics.color, topics.depth, topics.color_info}) {
    if (rosbag::View(bag, rosbag::TopicQuery(topic)).size() == 0) return false;
  }
  return true;
}

}  // namespace softbody::evaluation
