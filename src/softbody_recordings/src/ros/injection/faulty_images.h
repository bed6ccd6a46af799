#pragma once

#include <sensor_msgs/Image.h>

#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

/// Adds the image faults to one stream.
class FaultyImages {
 public:
  /// @param topic for error messages.
  FaultyImages(std::string topic, bool is_depth, const ImageFaults& faults);

  /// The next image with its faults.
  /// @throw std::invalid_argument if the encoding is not supported, or the number of bytes is wrong.
  sensor_msgs::Image next(const sensor_msgs::Image& original);

  std::size_t count() const { return count_; }

 private:
  void changeColor(bool occluded, sensor_msgs::Image* image) const;
  void changeDepth(bool occluded, sensor_msgs::Image* image) const;

  std::string topic_;
  bool is_depth_;
  ImageFaults faults_;
  Nanoseconds first_ = 0;  ///< stamp of the first image
  std::size_t count_ = 0;
};

}  // namespace softbody::injection
