#include "softbody_sim/ros/conversions.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_sim/constraints/obstacle_description.h"

namespace softbody {
namespace {

std_msgs::ColorRGBA shade(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, float confidence) {
  const Eigen::Vector3f inferred(0.72f, 0.74f, 0.78f), observed(0.93f, 0.72f, 0.42f);
  const double facing = std::max(0.0, -normal.dot(position.normalized()));
  const auto light = static_cast<float>(0.35 + 0.65 * facing);
  return colorMessage(light * (inferred + confidence * (observed - inferred)));
}

}  // namespace

PinRegion fromMessage(const softbody_msgs::PinRegion& message) {
  requireTopicName(message.name);
  const PinRegion region{message.name, message.header.frame_id, fromPoint32(message.min),
                         fromPoint32(message.max)};
  if ((region.min.array() <= region.max.array()).all()) return region;  // false for NaN
  throw std::invalid_argument(fmt::format(
      "the box of pin '{}' is empty: min ({:.6g}, {:.6g}, {:.6g}) is not below max ({:.6g}, {:.6g}, {:.6g})",
      region.name, region.min.x(), region.min.y(), region.min.z(), region.max.x(), region.max.y(),
      region.max.z()));
}

std_msgs::ColorRGBA colorMessage(const Eigen::Vector3f& rgb) {
  std_msgs::ColorRGBA color;
  color.r = rgb.x();
  color.g = rgb.y();
  color.b = rgb.z();
  color.a = 1.0f;
  return color;
}

visualization_msgs::Marker makeSurfaceMarker(const MeshTopology& topology, const MeshState& state) {
  if (state.revision != topology.revision || state.vertices.rows() != topology.rest_vertices.rows()) {
    throw std::invalid_argument(
        fmt::format("state has revision {} and {} vertices, but topology has revision {} and {} vertices",
                    state.revision, state.vertices.rows(), topology.revision, topology.rest_vertices.rows()));
  }
  visualization_msgs::Marker marker;
  marker.ns = "surface";
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.a = 1.0f;
  const Points normals = vertexNormals(state.vertices, topology.triangles);
  marker.points.reserve(static_cast<std::size_t>(topology.triangles.size()));
  marker.colors.reserve(static_cast<std::size_t>(topology.triangles.size()));
  for (const int vertex : topology.triangles.reshaped<Eigen::RowMajor>()) {
    marker.points.push_back(pointMessage(state.vertices.row(vertex)));
    marker.colors.push_back(shade(state.vertices.row(vertex), normals.row(vertex),
                                  state.confidence[static_cast<std::size_t>(vertex)]));
  }
  return marker;
}

}  // namespace softbody
