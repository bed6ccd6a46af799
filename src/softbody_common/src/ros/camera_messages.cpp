#include "softbody_common/ros/camera_messages.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"

namespace softbody {
namespace {

// In units of the image's width. A lens of these focal lengths sees 174 degrees or half a degree.
constexpr double kShortestFocalLength = 0.025, kLongestFocalLength = 100.0;
// The centre's distance from the image, in image sizes: an image may be a part of a larger one.
constexpr double kFarthestCentre = 10.0;

void requireSize(const sensor_msgs::CameraInfo& info) {
  const bool empty = info.width == 0 || info.height == 0;
  if (!empty && info.width <= kLargestImageSide && info.height <= kLargestImageSide) return;
  throw std::invalid_argument(
      fmt::format("camera_info: the image size is {}x{}; allowed: 1 to {} pixels a side", info.width,
                  info.height, kLargestImageSide));
}

void requireFocalLength(double focal_length, const char* name, std::uint32_t width) {
  // The comparison is negated so that NaN is refused too.
  if (focal_length >= kShortestFocalLength * width && focal_length <= kLongestFocalLength * width) return;
  throw std::invalid_argument(fmt::format(
      "camera_info: the focal length {} is {:.6g} pixels; allowed: {:.6g} to {:.6g} for an image of "
      "this width (is the camera calibrated?)",
      name, focal_length, kShortestFocalLength * width, kLongestFocalLength * width));
}

void requireCentre(double centre, const char* name, std::uint32_t size) {
  if (std::abs(centre) <= kFarthestCentre * size) return;
  throw std::invalid_argument(fmt::format(
      "camera_info: the centre {} is {:.6g}; allowed: up to {:.6g} pixels from the image's corner", name,
      centre, kFarthestCentre * size));
}

}  // namespace

Pinhole pinholeFromMessage(const sensor_msgs::CameraInfo& info) {
  requireSize(info);
  const bool has_projection = info.P[0] != 0.0;
  Pinhole camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  camera.fx = has_projection ? info.P[0] : info.K[0];
  camera.fy = has_projection ? info.P[5] : info.K[4];
  camera.cx = has_projection ? info.P[2] : info.K[2];
  camera.cy = has_projection ? info.P[6] : info.K[5];
  requireFocalLength(camera.fx, "fx", info.width);
  requireFocalLength(camera.fy, "fy", info.width);
  requireCentre(camera.cx, "cx", info.width);
  requireCentre(camera.cy, "cy", info.height);
  return camera;
}

sensor_msgs::CameraInfo toMessage(const Pinhole& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace softbody
