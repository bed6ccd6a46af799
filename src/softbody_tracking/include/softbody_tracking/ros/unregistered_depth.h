#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>

#include "softbody_tracking/camera/camera_ingest.h"

namespace softbody {

/// T_target_source at a stamp. @throw std::exception if tf does not know it.
using TransformLookup = std::function<Eigen::Isometry3d(const std::string& target, const std::string& source,
                                                        const ros::Time& stamp)>;

/// The camera of depth images that are not registered to colour. Depth counts as registered if it has
/// colour's size, and colour's intrinsics or no CameraInfo.
/// @param depth_info null: none has come. @return nothing: depth is registered.
/// @throw std::invalid_argument if depth is not registered and its CameraInfo or its transform is missing.
std::optional<DepthCamera> unregisteredDepthCamera(const sensor_msgs::Image& color,
                                                   const sensor_msgs::Image& depth,
                                                   const sensor_msgs::CameraInfo& color_info,
                                                   const sensor_msgs::CameraInfo* depth_info,
                                                   const TransformLookup& lookup);

}  // namespace softbody
