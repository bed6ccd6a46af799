#include "ros/pose_marker_message.h"

#include <array>
#include <cmath>

#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

constexpr double kRelativeScale =
    1.2;  // of the body's largest extent, so that arrows and rings lie outside of it

Marker meshMarker(const MeshTopology& mesh) {
  Marker marker;
  marker.type = Marker::TRIANGLE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.r = 0.3f;
  marker.color.g = 0.7f;
  marker.color.b = 1.0f;
  marker.color.a = 0.6f;
  marker.points.reserve(3 * mesh.triangles.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      marker.points.push_back(pointMessage(mesh.rest_vertices.row(mesh.triangles(t, k))));
    }
  }
  return marker;
}

InteractiveMarkerControl meshControl(const MeshTopology& mesh) {
  InteractiveMarkerControl control;
  control.name = "body";
  control.orientation.w = 1.0;
  control.interaction_mode = InteractiveMarkerControl::MOVE_ROTATE_3D;
  control.always_visible = 1;
  control.markers.push_back(meshMarker(mesh));
  return control;
}

/// A control along or about an axis. rviz uses the control's x axis, which a quarter turn takes to the wanted
/// axis.
InteractiveMarkerControl axisControl(const std::array<double, 3>& quarter_turn, std::uint8_t mode,
                                     const std::string& name) {
  InteractiveMarkerControl control;
  control.name = name;
  control.interaction_mode = mode;
  control.orientation.w = std::sqrt(0.5);
  control.orientation.x = std::sqrt(0.5) * quarter_turn[0];
  control.orientation.y = std::sqrt(0.5) * quarter_turn[1];
  control.orientation.z = std::sqrt(0.5) * quarter_turn[2];
  return control;
}

}  // namespace

visualization_msgs::InteractiveMarker makePoseMarker(const softbody_msgs::MeshTopology& message,
                                                     const geometry_msgs::PoseStamped& pose) {
  const MeshTopology mesh = fromMessage(message);
  const Eigen::RowVector3d size =
      mesh.rest_vertices.colwise().maxCoeff() - mesh.rest_vertices.colwise().minCoeff();
  visualization_msgs::InteractiveMarker marker;
  marker.header = pose.header;
  marker.pose = pose.pose;
  marker.name = "body";
  marker.scale = static_cast<float>(kRelativeScale * size.maxCoeff());
  marker.controls.push_back(meshControl(mesh));
  const std::array<std::array<double, 3>, 3> turns{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
  const std::array<std::string, 3> names{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    marker.controls.push_back(
        axisControl(turns[axis], InteractiveMarkerControl::MOVE_AXIS, "move " + names[axis]));
    marker.controls.push_back(
        axisControl(turns[axis], InteractiveMarkerControl::ROTATE_AXIS, "turn about " + names[axis]));
  }
  return marker;
}

}  // namespace softbody
