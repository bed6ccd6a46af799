#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/Marker.h>

#include <vector>

#include "softbody_tracking/tracker/body_tracker.h"

/// Tracked features as messages; headers are the caller's.
namespace softbody {

/// Fields x y z [m], id (int32), u v [px], confidence (0..1), all but id float32.
sensor_msgs::PointCloud2 makeFeatureCloud(const std::vector<TrackedFeature>& features);

/// Feature vectors: a LINE_LIST from each feature's reference position to its present one.
visualization_msgs::Marker makeFeatureMarker(const std::vector<TrackedFeature>& features);

}  // namespace softbody
