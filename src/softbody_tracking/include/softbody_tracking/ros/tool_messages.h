#pragma once

#include <geometry_msgs/Polygon.h>
#include <geometry_msgs/PoseWithCovariance.h>

#include "softbody_tracking/tool/tool_tracker.h"

/// A tracked tool as messages. The caller sets the headers.
namespace softbody {

geometry_msgs::PoseWithCovariance toMessage(const ToolObservation& observation);

/// The blade's corners, transformed by T.
geometry_msgs::Polygon bladePolygon(const Points& blade, const Eigen::Isometry3d& T);

}  // namespace softbody
