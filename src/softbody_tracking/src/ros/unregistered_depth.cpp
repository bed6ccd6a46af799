#include "softbody_tracking/ros/unregistered_depth.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "softbody_common/ros/camera_messages.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kSameFocalLength = 0.01, kSameCentre_px = 2.0;

bool haveSameIntrinsics(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  const auto near = [](double x, double y, double tolerance) { return std::abs(x - y) <= tolerance; };
  return near(a.K[0], b.K[0], kSameFocalLength * a.K[0]) && near(a.K[4], b.K[4], kSameFocalLength * a.K[4]) &&
         near(a.K[2], b.K[2], kSameCentre_px) && near(a.K[5], b.K[5], kSameCentre_px);
}

Eigen::Isometry3d depthInColor(const std_msgs::Header& color, const std_msgs::Header& depth,
                               const TransformLookup& lookup) try {
  const std::string target = withoutSlash(color.frame_id), source = withoutSlash(depth.frame_id);
  return target == source ? Eigen::Isometry3d::Identity() : lookup(target, source, depth.stamp);
} catch (const std::exception& error) {
  throw std::invalid_argument(
      fmt::format("depth is not registered to colour, and tf does not say where '{}' is in '{}' ({}): "
                  "publish this transform on "
                  "/tf_static, or set depth:= to the driver's registered depth",
                  depth.frame_id, color.frame_id, error.what()));
}

}  // namespace

std::optional<DepthCamera> unregisteredDepthCamera(const sensor_msgs::Image& color,
                                                   const sensor_msgs::Image& depth,
                                                   const sensor_msgs::CameraInfo& color_info,
                                                   const sensor_msgs::CameraInfo* depth_info,
                                                   const TransformLookup& lookup) {
  const bool same_size = color.width == depth.width && color.height == depth.height;
  if (same_size && (depth_info == nullptr || haveSameIntrinsics(color_info, *depth_info)))
    return std::nullopt;
  if (depth_info == nullptr) {
    throw std::invalid_argument(fmt::format(
        "depth is not registered to colour ({}x{} and {}x{} pixels), and depth's camera_info is missing: "
        "set depth_info:= to its topic, or depth:= to the driver's registered depth (RealSense: "
        "align_depth:=true)",
        depth.width, depth.height, color.width, color.height));
  }
  return DepthCamera{pinholeFromMessage(*depth_info), distortionFromMessage(*depth_info),
                     depthInColor(color.header, depth.header, lookup)};
}

}  // namespace softbody
