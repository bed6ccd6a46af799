#pragma once

#include <visualization_msgs/Marker.h>

#include <vector>

#include "softbody_tracking/camera/point_cloud.h"

namespace softbody {

/// Coloured points for rviz, without a header. A marker replaces the one before. rviz keeps point clouds
/// instead, for as long as their stamps are in its future, so after each jump back of time.
visualization_msgs::Marker makePointsMarker(const std::vector<ColoredPoint>& points);

}  // namespace softbody
