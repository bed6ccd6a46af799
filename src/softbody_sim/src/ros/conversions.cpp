#include "softbody_sim/ros/conversions.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/constraints/obstacle_description.h"

namespace softbody {
namespace {

std_msgs::ColorRGBA shade(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, float confidence) {
  const Eigen::Vector3f inferred(0.72f, 0.74f, 0.78f), observed(0.93f, 0.72f, 0.42f);
  const double facing = std::max(0.0, -normal.dot(position.normalized()));
  const auto light = static_cast<float>(0.35 + 0.65 * facing);
  return colorMessage(light * (inferred + confidence * (observed - inferred)));
}

/// A message with the box of a pin.
template <typename Message>
PinRegion pinRegionOf(const Message& message) {
  requireTopicName(message.name);
  const PinRegion region{message.name, message.header.frame_id, fromPoint32(message.min),
                         fromPoint32(message.max)};
  if ((region.min.array() <= region.max.array()).all()) return region;  // false for NaN
  throw std::invalid_argument(fmt::format(
      "the box is empty: min ({:.6g}, {:.6g}, {:.6g}) is not below max ({:.6g}, {:.6g}, {:.6g})",
      region.min.x(), region.min.y(), region.min.z(), region.max.x(), region.max.y(), region.max.z()));
}

/// What parameters and messages call the same.
const std::pair<std::string, std::string> kObstacleFields[] = {
    {"radius_m", "radius"},
    {"rounding_m", "radius"},
    {"length_m", "length"},
    {"size_m", "size"},
    {"the quaternion of its pose (last four numbers: x y z w)", "the quaternion of its pose"}};

/// What is wrong with a parameter, as what is wrong with a field. Whose it is, the message's reader says.
std::string aboutField(std::string fault, const std::string& obstacle) {
  for (const std::string& owner : {"obstacle '" + obstacle + "': ", std::string("parameter ")})
    if (fault.compare(0, owner.size(), owner) == 0) fault.erase(0, owner.size());
  for (const auto& [key, field] : kObstacleFields)
    if (fault.compare(0, key.size(), key) == 0) fault.replace(0, key.size(), field);
  return fault;
}

}  // namespace

PinRegion fromMessage(const softbody_msgs::PinRegion& message) { return pinRegionOf(message); }

PinRegion fromMessage(const softbody_msgs::PinRequest& request) { return pinRegionOf(request); }

/// The checks are those of the parameter `obstacles`.
ObstacleDescription fromMessage(const softbody_msgs::SetObstacleRequest& request) {
  requireTopicName(request.name);
  YAML::Node map;
  map["name"] = request.name;
  map["frame"] = request.header.frame_id;
  map["shape"] = request.shape;
  const geometry_msgs::Point& p = request.pose.position;
  const geometry_msgs::Quaternion& q = request.pose.orientation;
  map["pose"] = std::vector<double>{p.x, p.y, p.z, q.x, q.y, q.z, q.w};
  map[request.shape == "box" ? "rounding_m" : "radius_m"] = request.radius;
  map["length_m"] = request.length;
  map["friction"] = request.friction;
  map["size_m"] = std::vector<double>{request.size.x, request.size.y, request.size.z};
  Parameters parameters(map);
  try {
    return readObstacle(parameters);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(aboutField(error.what(), request.name));
  }
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
