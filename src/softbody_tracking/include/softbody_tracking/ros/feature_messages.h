#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/Marker.h>

#include <vector>

#include "softbody_tracking/tracker/tracking_result.h"

/// Tracked features as messages. The caller sets the headers.
namespace softbody {

/// A cloud with the fields x y z [m], u v [px], confidence (0..1), all float32, and id (int32).
sensor_msgs::PointCloud2 makeFeatureCloud(const std::vector<TrackedFeature>& features);

/// Feature vectors: a LINE_LIST from each feature's reference position to its present position.
visualization_msgs::Marker makeFeatureMarker(const std::vector<TrackedFeature>& features);

}  // namespace softbody
