#pragma once

#include <functional>
#include <string>

#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {

struct BagOptions {
  std::string path;
  int frames = 150;
  double rate_hz = 30.0;
  bool labels = false;  ///< also the true labels of the pixels
  bool small = false;   ///< bz2: half the size, but slow to write and to read; otherwise lz4
};

/// Writes the camera's topics, the truth and /tf into a bag. The record time is the header stamp, and the
/// first stamp is constant, so the same camera gives the same bytes. The file appears when it is complete.
/// @param progress called with the number of written frames. @throw std::runtime_error
/// if it cannot be written.
void writeBag(VirtualCamera* camera, const BagOptions& options, const std::function<void(int)>& progress);

}  // namespace softbody::virtual_camera
