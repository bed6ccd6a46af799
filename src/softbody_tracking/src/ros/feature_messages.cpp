#include "softbody_tracking/ros/feature_messages.h"

#include <sensor_msgs/image_encodings.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cstdint>
#include <opencv2/core.hpp>

#include "softbody_common/images/pixel_labels.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kLineWidth_m = 0.0008;  // [m] thin, because up to a thousand lines are shown

}  // namespace

sensor_msgs::PointCloud2 makeFeatureCloud(const std::vector<TrackedFeature>& features) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(7, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "id", 1, PointField::INT32, "u", 1, PointField::FLOAT32,
                                "v", 1, PointField::FLOAT32, "confidence", 1, PointField::FLOAT32);
  modifier.resize(features.size());
  sensor_msgs::PointCloud2Iterator<float> position(cloud, "x"), pixel(cloud, "u"),
      confidence(cloud, "confidence");
  sensor_msgs::PointCloud2Iterator<std::int32_t> id(cloud, "id");
  for (const TrackedFeature& feature : features) {
    for (int k = 0; k < 3; ++k) position[k] = static_cast<float>(feature.position[k]);
    for (int k = 0; k < 2; ++k) pixel[k] = static_cast<float>(feature.pixel[k]);
    *id = feature.id;
    *confidence = static_cast<float>(feature.confidence);
    ++position, ++pixel, ++confidence, ++id;
  }
  cloud.is_dense = true;
  return cloud;
}

visualization_msgs::Marker makeFeatureMarker(const std::vector<TrackedFeature>& features) {
  visualization_msgs::Marker marker;
  marker.ns = "feature_vectors";
  marker.type = visualization_msgs::Marker::LINE_LIST;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = kLineWidth_m;
  marker.color.b = marker.color.a = 1.0f;
  marker.color.g = 0.4f;
  for (const TrackedFeature& feature : features) {
    marker.points.push_back(pointMessage(feature.reference));
    marker.points.push_back(pointMessage(feature.position));
  }
  return marker;
}

sensor_msgs::Image makeLabelImage(const TrackingResult& result, const cv::Size& size) {
  sensor_msgs::Image image;
  image.encoding = sensor_msgs::image_encodings::MONO8;
  image.width = image.step = static_cast<std::uint32_t>(size.width);
  image.height = static_cast<std::uint32_t>(size.height);
  image.data.assign(std::size_t{image.step} * image.height, labels::kUnknown);
  cv::Mat1b pixels(size.height, size.width, image.data.data());
  if (!result.labelled.empty()) result.labels.copyTo(pixels(result.labelled));
  return image;
}

}  // namespace softbody
