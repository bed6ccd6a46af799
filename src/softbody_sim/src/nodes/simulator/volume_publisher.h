#pragma once

#include <ros/ros.h>
#include <softbody_msgs/CutHistory.h>
#include <softbody_msgs/TetTopology.h>

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"

namespace softbody {

/// Publishes the volume's topology, edits, state and stage times. Topology and edits are latched; the
/// topology is sent again every second.
class VolumePublisher {
 public:
  VolumePublisher(ros::NodeHandle node, std::string body_frame);

  /// @param stamp of the first frame with this topology; 0: the body is not placed.
  void publishTopology(const TetTopology& topology, const ros::Time& stamp);
  /// Publishes a topology and the edits that it comes from.
  void publishEdited(const CuttableBody& body, const ros::Time& stamp);
  /// Whether the published topology has the stamp of a frame.
  bool topologyHasStamp() const { return !topology_->header.stamp.isZero(); }

  void publishState(const MeshState& state, const std_msgs::Header& header);
  void publishTiming(const std::vector<StageTime>& stages, const std_msgs::Header& header);

 private:
  std::string body_frame_;
  softbody_msgs::CutHistoryConstPtr edits_;
  softbody_msgs::TetTopologyPtr topology_;
  ros::Publisher edits_publisher_, topology_publisher_, state_publisher_, timing_publisher_;
  ros::Timer topology_timer_;
};

}  // namespace softbody
