#pragma once

#include <ros/ros.h>
#include <softbody_msgs/MeshTopology.h>

#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_common/time/stage_timer.h"

namespace softbody {

/// Publishes the visual mesh: topology, state, marker, stage times, and what planners read. The topology is
/// latched and sent again every second.
class SurfacePublisher {
 public:
  explicit SurfacePublisher(ros::NodeHandle node);

  /// Publishes a topology, now and every second: always the same message, so that nodelets know it again.
  void setTopology(const softbody_msgs::MeshTopologyConstPtr& topology);

  /// Marker, mesh and points are published only while somebody subscribes to them.
  void publishState(const MeshTopology& topology, const MeshState& state, const std_msgs::Header& header);

  /// Adds the latency from the camera to now.
  void publishTiming(std::vector<StageTime> stages, const std_msgs::Header& header);

 private:
  void publishForPlanners(const MeshTopology& topology, const MeshState& state,
                          const std_msgs::Header& header);
  void publishTopology();

  softbody_msgs::MeshTopologyConstPtr topology_;  ///< null: none yet
  ros::Publisher topology_publisher_, state_publisher_, marker_publisher_, mesh_publisher_, points_publisher_,
      timing_publisher_;
  ros::Timer topology_timer_;
};

}  // namespace softbody
