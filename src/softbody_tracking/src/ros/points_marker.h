#pragma once

#include <visualization_msgs/Marker.h>

#include <vector>

#include "softbody_tracking/camera/point_cloud.h"

namespace softbody {

/// Coloured points for rviz, without a header. A marker replaces the one before. rviz would keep point clouds
/// after each jump back of time, as long as their stamps are in its future.
visualization_msgs::Marker makePointsMarker(const std::vector<ColoredPoint>& points);

}  // namespace softbody
