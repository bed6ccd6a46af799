#pragma once

#include <functional>
#include <string>

#include "softbody_recordings/injection/deliveries.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

struct InjectorOptions {
  std::string input, output;  ///< bags
  std::string camera = "/camera";
  bool in_color = true, in_depth = true;  ///< which stream's deliveries go wrong
  DeliveryFaults deliveries;
  ImageFaults images;
};

/// What was written.
struct InjectionReport {
  std::size_t color_read = 0, color_written = 0, depth_read = 0, depth_written = 0, copied = 0;
};

/// Writes the input with faults in the camera's colour and depth images; every other message is copied as it
/// is. The same options give the same bytes. The output appears under its name when it is complete.
/// @param progress is told the share that has been written (0..1).
/// @throw std::invalid_argument if images are missing or have encodings that cannot be changed;
/// rosbag::BagException.
InjectionReport inject(const InjectorOptions& options, const std::function<void(double)>& progress);

}  // namespace softbody::injection
