#include "ros/pose_marker_message.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

using Control = visualization_msgs::InteractiveMarkerControl;

softbody_msgs::MeshTopology boxMessage() {
  softbody_msgs::MeshTopology message = toMessage(makeBox().surface);
  message.vertex_parents.assign(message.rest_vertices.size(), -1);
  message.triangle_bodies.assign(message.triangles.size(), 0);
  message.cut_triangles.assign(message.triangles.size(), 0);
  return message;
}

TEST(PoseMarkerMessage, ShowsTheMeshWhereThePoseSays) {
  const softbody_msgs::MeshTopology mesh = boxMessage();
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "camera";
  pose.pose.position.z = 0.5;
  pose.pose.orientation.w = 1.0;
  const auto marker = makePoseMarker(mesh, pose);
  EXPECT_EQ(marker.header.frame_id, "camera");
  EXPECT_EQ(marker.pose, pose.pose);
  EXPECT_GE(marker.scale, 0.2f) << "the controls stand out of the body";
  const auto& shown = marker.controls.front().markers.front();
  ASSERT_EQ(shown.points.size(), 3 * mesh.triangles.size());
  EXPECT_TRUE(shown.header.frame_id.empty()) << "so it goes with the marker";
  for (std::size_t i = 0; i < shown.points.size(); ++i) {
    const auto& vertex = mesh.rest_vertices[mesh.triangles[i / 3].vertex_indices[i % 3]];
    EXPECT_FLOAT_EQ(shown.points[i].x, vertex.x);
    EXPECT_FLOAT_EQ(shown.points[i].y, vertex.y);
    EXPECT_FLOAT_EQ(shown.points[i].z, vertex.z);
  }
}

TEST(PoseMarkerMessage, MovesAlongAndTurnsAboutEveryAxis) {
  const auto marker = makePoseMarker(boxMessage(), geometry_msgs::PoseStamped());
  for (const std::uint8_t mode : {Control::MOVE_AXIS, Control::ROTATE_AXIS}) {
    Eigen::Vector3d axes = Eigen::Vector3d::Zero();
    for (const Control& control : marker.controls) {
      if (control.interaction_mode != mode) continue;
      const auto& q = control.orientation;
      axes += (Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitX()).cwiseAbs();
    }
    EXPECT_TRUE(axes.isApprox(Eigen::Vector3d::Ones(), 1e-9)) << axes.transpose();
  }
}

TEST(PoseMarkerMessage, RefusesTrianglesOfNoMesh) {
  softbody_msgs::MeshTopology mesh = boxMessage();
  mesh.triangles.front().vertex_indices[0] = 99999;
  EXPECT_THROW(makePoseMarker(mesh, geometry_msgs::PoseStamped()), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
