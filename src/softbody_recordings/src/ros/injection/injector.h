#pragma once

#include <functional>
#include <string>

#include "softbody_recordings/injection/deliveries.h"
#include "softbody_recordings/injection/image_faults.h"

namespace softbody::injection {

struct InjectorOptions {
  std::string input, output;  ///< bags
  std::string camera = "/camera";
  bool in_color = true, in_depth = true;  ///< the streams with delivery faults
  DeliveryFaults deliveries;
  ImageFaults images;
};

/// Numbers of messages.
struct InjectionReport {
  std::size_t color_read = 0, color_written = 0, depth_read = 0, depth_written = 0, copied = 0;
};

/// Copies a bag and adds faults to the camera's colour and depth images. All other messages stay unchanged.
/// The same options give the same bytes. The output file appears when it is complete.
/// @param progress called with the written share, 0..1.
/// @throw std::invalid_argument if images are missing or have an unsupported encoding; rosbag::BagException.
InjectionReport inject(const InjectorOptions& options, const std::function<void(double)>& progress);

}  // namespace softbody::injection
