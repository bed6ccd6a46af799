#include "ros/blade_trail.h"

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

using visualization_msgs::Marker;

constexpr Nanoseconds kLength = 1'500'000'000;  // [ns] time that the trail shows
constexpr Nanoseconds kMaxGap =
    250'000'000;                     // [ns] between poses of one trail; a blink of the markers is shorter
constexpr double kLifetime_s = 0.5;  // [s] a marker that is not renewed disappears
constexpr double kOutlineWidth_m = 0.0015;  // [m] of the present outline
constexpr double kTrailWidth_m = 0.0006;    // [m] of the trail; thinner, so that the outline stands out
constexpr float kOutlineAlpha = 0.3f;       // of an earlier outline, as a factor of its path's

Marker lineList(const char* name, double width, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = Marker::LINE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = width;
  marker.color.r = marker.color.a = 1.0f;
  marker.color.g = 0.67f;
  marker.lifetime = ros::Duration(kLifetime_s);
  return marker;
}

void addLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, float alpha_a, float alpha_b,
             Marker* marker) {
  marker->points.push_back(pointMessage(a));
  marker->points.push_back(pointMessage(b));
  for (const float alpha : {alpha_a, alpha_b}) {
    marker->colors.push_back(marker->color);
    marker->colors.back().a = alpha;
  }
}

void addOutline(const Points& corners, float alpha, Marker* marker) {
  for (Eigen::Index i = 0; i < corners.rows(); ++i)
    addLine(corners.row(i), corners.row((i + 1) % corners.rows()), alpha, alpha, marker);
}

}  // namespace

void BladeTrail::add(Nanoseconds stamp, const Eigen::Isometry3d& T_fixed_tool) {
  if (!outlines_.empty() && (stamp < outlines_.back().stamp || stamp - outlines_.back().stamp > kMaxGap))
    outlines_.clear();
  outlines_.push_back({stamp, transformed(blade_, T_fixed_tool)});
  while (stamp - outlines_.front().stamp > kLength) outlines_.pop_front();
}

float BladeTrail::freshness(const Outline& outline) const {
  return 1.0f - static_cast<float>(outlines_.back().stamp - outline.stamp) / static_cast<float>(kLength);
}

visualization_msgs::MarkerArray BladeTrail::markers(const std_msgs::Header& header) const {
  visualization_msgs::MarkerArray message;
  if (outlines_.empty()) return message;
  Marker blade = lineList("blade", kOutlineWidth_m, header), trail = lineList("trail", kTrailWidth_m, header);
  addOutline(outlines_.back().corners, 1.0f, &blade);
  trail.color.a = 0.99f;  // rviz blends coloured lines only if the marker itself is not opaque
  for (std::size_t k = 0; k + 1 < outlines_.size(); ++k) {
    const float from = freshness(outlines_[k]), to = freshness(outlines_[k + 1]);
    addOutline(outlines_[k].corners, kOutlineAlpha * from, &trail);
    for (Eigen::Index i = 0; i < blade_.rows(); ++i)
      addLine(outlines_[k].corners.row(i), outlines_[k + 1].corners.row(i), from, to, &trail);
  }
  if (trail.points.empty()) trail.action = Marker::DELETE;
  message.markers = {blade, trail};
  return message;
}

}  // namespace softbody
