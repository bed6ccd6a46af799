#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/messages/input.h"

namespace softbody::fuzz {

/// The messages of one frame.
struct CameraFrame {
  sensor_msgs::Image color, depth;
  sensor_msgs::CompressedImage jpeg_color, png_depth;
  sensor_msgs::CameraInfo info;
};

/// Some frames of a scene of the virtual camera, without noise.
class CameraFrames {
 public:
  /// @param times in the scene [s]. @param rectified as camera_ingest sends them, otherwise as a camera.
  CameraFrames(const std::string& scene, int width, int height, const std::vector<double>& times,
               bool rectified);

  /// The next frame, with the present time as its stamp.
  CameraFrame next();

  /// At the first time.
  const Eigen::Isometry3d& bodyPose() const { return T_camera_body_; }
  const std::optional<Eigen::Isometry3d>& toolPose() const { return T_camera_tool_; }

 private:
  std::vector<CameraFrame> frames_;
  std::size_t next_ = 0;
  Eigen::Isometry3d T_camera_body_;
  std::optional<Eigen::Isometry3d> T_camera_tool_;
};

/// Topics of colour, depth and camera_info, relative to the graph's namespace.
struct FrameTopics {
  std::string color, depth, info;
};
extern const FrameTopics kRawTopics, kRectifiedTopics;

/// Whether the images come as they are, or as JPEG and PNG on topics below theirs.
enum class Transport { kRaw, kCompressed };

/// The three topics of frames. Mostly all messages of a frame come, in any order, and some of them are
/// mutated.
class FrameInput : public Input {
 public:
  FrameInput(DrivenNode* node, const FrameTopics& topics, CameraFrames* frames,
             Transport transport = Transport::kRaw);

  int give(bool bad, Choice* choice) override;
  /// A frame of a good camera. @return its stamp.
  ros::Time giveGood();

 private:
  CameraFrames* frames_;
  CameraFrame frame_;
  std::unique_ptr<Input> color_, depth_, info_;
};

}  // namespace softbody::fuzz
