#pragma once

#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/Marker.h>

#include <opencv2/core/types.hpp>
#include <vector>

#include "softbody_tracking/tracker/tracking_result.h"

/// What the tracker found in a frame, as messages. The caller sets the headers.
namespace softbody {

/// A cloud with the fields x y z [m], u v [px], confidence (0..1), all float32, and id (int32).
sensor_msgs::PointCloud2 makeFeatureCloud(const std::vector<TrackedFeature>& features);

/// Feature vectors: a LINE_LIST from each feature's reference position to its present position.
visualization_msgs::Marker makeFeatureMarker(const std::vector<TrackedFeature>& features);

/// What each pixel shows: mono8, see softbody_common/images/pixel_labels.h; kUnknown outside of the labelled
/// part. @param size of the frame [px].
sensor_msgs::Image makeLabelImage(const TrackingResult& result, const cv::Size& size);

}  // namespace softbody
