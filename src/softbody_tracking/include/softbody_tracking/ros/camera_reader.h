#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <functional>
#include <set>
#include <string>

#include "softbody_tracking/camera/camera_images.h"

namespace softbody {

/// T_target_source at a stamp. @throw std::exception if tf does not know it.
using TransformLookup = std::function<Eigen::Isometry3d(const std::string& target, const std::string& source,
                                                        const ros::Time& stamp)>;

/// The messages of one frame. Compressed images are decompressed before.
struct CameraMessages {
  const sensor_msgs::Image& color;
  const sensor_msgs::Image* depth;  ///< null: none
  const sensor_msgs::CameraInfo& color_info;
  const sensor_msgs::CameraInfo* depth_info;  ///< null: none has come
};

/// Reads the messages of an RGB-D camera: byte order, rows and encodings of images, binning and region of
/// interest, lenses, topics of rectified images, and depth in its own frame. The only place that does so: the
/// live graph, replay, checks and measures understand a camera alike.
class CameraReader {
 public:
  /// What is said once about a camera that is not as usual.
  using Note = std::function<void(const std::string& sentence)>;

  /// Images of a topic image_rect... are rectified: their D is ignored, and P is their camera.
  struct Config {
    std::string color_topic, depth_topic;
    double depth_scale = 0.0;  ///< metres per unit of depth; 0: by the encoding
  };

  CameraReader(Config config, TransformLookup lookup, Note note);

  /// Depth is registered to colour if it has colour's size, colour's frame (or tf says that the frames are
  /// one) and colour's intrinsics (or no CameraInfo). Other depth has its own camera, whose pose comes from
  /// tf. An image without frame_id is in the frame of the other one.
  /// @return depth may share memory with its message, so the message must outlive it.
  /// @throw std::invalid_argument with a sentence if the messages do not describe a frame; then nothing has
  /// changed.
  CameraImages read(const CameraMessages& messages);
  /// The same without the pixels of colour, for those who hand on the message itself.
  CameraImages readWithoutColor(const CameraMessages& messages);

 private:
  void tell(const std::string& sentence);
  void tellAbout(const CameraMessages& messages, const CameraImages& images);

  Config config_;
  bool color_rectified_, depth_rectified_;
  TransformLookup lookup_;
  Note note_;
  std::set<std::string> told_;
};

}  // namespace softbody
