#pragma once

#include <opencv2/imgproc.hpp>

#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

/// Frame k of a scene, made from the images as a camera with 30 Hz sends them.
inline softbody::RgbdFrame frameOf(softbody::virtual_camera::VirtualCamera* camera, int k) {
  const softbody::virtual_camera::Capture capture = camera->capture(k, k / 30.0);
  softbody::CameraImages images;
  cv::cvtColor(capture.color, images.color, cv::COLOR_RGB2BGR);
  images.depth = capture.depth_mm;
  images.rectified = camera->pinhole();
  images.stamp = 1 + k * 33333333LL;
  return softbody::CameraIngest({}).process(images);
}

/// @param config folder of the shipped objects.
inline softbody::virtual_camera::VirtualCamera cameraOf(const std::string& scene, const std::string& config) {
  softbody::virtual_camera::CameraSetup setup;
  setup.scene = scene;
  setup.config_folder = config;
  return softbody::virtual_camera::makeCamera(setup);
}
