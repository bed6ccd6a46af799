#pragma once

#include <sensor_msgs/Image.h>

#include <string>

#include "softbody_common/types.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

/// One stream of images, as the faults let them look.
class FaultyImages {
 public:
  /// @param topic for messages to people.
  FaultyImages(std::string topic, bool is_depth, const ImageFaults& faults);

  /// @throw std::invalid_argument if the image's encoding cannot be changed, or its bytes do not fit its
  /// size.
  sensor_msgs::Image next(const sensor_msgs::Image& original);

  std::size_t count() const { return count_; }

 private:
  void spoilColor(bool occluded, sensor_msgs::Image* image) const;
  void spoilDepth(bool occluded, sensor_msgs::Image* image) const;

  std::string topic_;
  bool is_depth_;
  ImageFaults faults_;
  Nanoseconds first_ = 0;  ///< stamp of the first image
  std::size_t count_ = 0;
};

}  // namespace softbody::injection
