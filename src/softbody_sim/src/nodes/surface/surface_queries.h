#pragma once

#include <ros/ros.h>
#include <softbody_msgs/ClosestPoint.h>
#include <softbody_msgs/SaveMesh.h>

#include <optional>
#include <string>

#include "nodes/frame_poses.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The services ~closest_point and ~save_mesh, about the state that was published last.
class SurfaceQueries {
 public:
  /// @param save_folder where meshes are written.
  SurfaceQueries(ros::NodeHandle private_node, std::string save_folder);

  /// @param topology stays valid until forget(), or the next call. @param state of the topology.
  void show(const MeshTopology* topology, MeshState state, const std_msgs::Header& header);
  /// There is no state, because the topology has changed.
  void forget() { shown_.reset(); }

 private:
  struct Shown {
    const MeshTopology* topology;
    MeshState state;
    std_msgs::Header header;
  };

  bool onClosestPoint(softbody_msgs::ClosestPoint::Request& request,
                      softbody_msgs::ClosestPoint::Response& response);
  bool onSaveMesh(softbody_msgs::SaveMesh::Request& request, softbody_msgs::SaveMesh::Response& response);
  const Shown& shown() const;
  Eigen::Isometry3d poseOf(const std::string& frame) const;
  void save(const std::string& name, softbody_msgs::SaveMesh::Response* response) const;

  std::string save_folder_;
  std::optional<Shown> shown_;
  FramePoses poses_;
  // Last, so that callbacks end before the members that they use.
  ros::ServiceServer closest_point_, save_mesh_;
};

}  // namespace softbody
