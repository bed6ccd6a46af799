/// Publishes a moving doll (18,650 vertices) as the surface node does, at a fixed rate.
/// scripts/measure_display starts it.
#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/Marker.h>

#include <cmath>
#include <exception>

#include "softbody_common/ros/conversions.h"
#include "softbody_sim/object/visual_mesh.h"
#include "softbody_sim/ros/conversions.h"

namespace {

constexpr char kFrame[] = "camera_color_optical_frame";
constexpr double kRate_hz = 60.0, kDistance_m = 0.5, kBend_per_m = 7.0;

/// The rest shape in front of the camera, bent about y; the bend swings once a second.
softbody::MeshState stateAt(double time, const softbody::MeshTopology& topology) {
  softbody::MeshState state;
  state.vertices = topology.rest_vertices;
  const double bend = kBend_per_m * std::sin(2.0 * M_PI * time);
  state.vertices.col(2).array() += kDistance_m + 0.5 * bend * state.vertices.col(0).array().square();
  state.confidence.assign(static_cast<std::size_t>(state.vertices.rows()), 1.0f);
  return state;
}

/// rviz needs to know the camera's frame.
void publishFrame() {
  static tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "camera_link";
  transform.child_frame_id = kFrame;
  transform.transform.rotation.w = 1.0;
  broadcaster.sendTransform(transform);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "display_load");
  ros::NodeHandle node("/softbody");
  publishFrame();
  try {
    softbody::Warnings warnings;
    const auto object = softbody::loadObjectDescription(CONFIG_DIR "/doll.yaml");
    const softbody::MeshTopology topology = softbody::loadVisualMesh(object, &warnings);
    const auto topologies = node.advertise<softbody_msgs::MeshTopology>("surface/topology", 1, true);
    const auto states = node.advertise<softbody_msgs::MeshState>("surface/state", 1);
    const auto markers = node.advertise<visualization_msgs::Marker>("surface/marker", 1);
    auto topology_message = softbody::toMessage(topology);
    topology_message.header.frame_id = "softbody";
    topologies.publish(topology_message);
    ros::Rate rate(kRate_hz);
    for (int frame = 0; ros::ok(); ++frame) {
      const softbody::MeshState state = stateAt(frame / kRate_hz, topology);
      std_msgs::Header header;
      header.stamp = ros::Time::now();
      header.frame_id = kFrame;
      if (states.getNumSubscribers() > 0) {
        auto message = softbody::toMessage(state);
        message.header = header;
        states.publish(message);
      }
      if (markers.getNumSubscribers() > 0) {
        auto message = softbody::makeSurfaceMarker(topology, state);
        message.header = header;
        markers.publish(message);
      }
      if (frame % 60 == 0) topologies.publish(topology_message);
      rate.sleep();
    }
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}
