#include "ros/points_marker.h"

namespace softbody {
namespace {

constexpr double kPointSize_m = 0.0008;

std_msgs::ColorRGBA colorMessage(std::uint32_t rgb) {
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(rgb >> 16 & 0xff) / 255.0f;
  color.g = static_cast<float>(rgb >> 8 & 0xff) / 255.0f;
  color.b = static_cast<float>(rgb & 0xff) / 255.0f;
  color.a = 1.0f;
  return color;
}

}  // namespace

visualization_msgs::Marker makePointsMarker(const std::vector<ColoredPoint>& points) {
  visualization_msgs::Marker marker;
  marker.ns = "points";
  marker.type = visualization_msgs::Marker::POINTS;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = kPointSize_m;
  marker.points.resize(points.size());
  marker.colors.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    marker.points[i].x = points[i].x;
    marker.points[i].y = points[i].y;
    marker.points[i].z = points[i].z;
    marker.colors.push_back(colorMessage(points[i].rgb));
  }
  return marker;
}

}  // namespace softbody
