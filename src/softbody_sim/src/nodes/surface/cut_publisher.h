#pragma once

#include <ros/ros.h>
#include <softbody_msgs/CutHistory.h>

#include <cstdint>
#include <optional>
#include <string>

#include "softbody_sim/cutting/binding/cuttable_surface.h"

namespace softbody {

/// Publishes cuts, and all edits of the body, which the simulator follows. An edit is pending until the
/// simulator's revision shows that it is made.
class CutPublisher {
 public:
  CutPublisher(ros::NodeHandle node, std::string body_frame);

  /// A cut that this node has decided on, for recordings.
  void publish(const Cut& cut, const ros::Time& stamp);
  /// The edits of the body; they are latched. @param pending the simulator has to follow.
  void publishEdits(const CuttableSurface& body, const ros::Time& stamp, bool pending);
  bool isPending() const { return pending_.has_value(); }
  /// The simulator has reached a revision.
  void confirm(std::uint32_t revision);
  /// Sends the edits again if the simulator is one revision behind.
  void resend(std::uint32_t simulator_revision);
  /// Whether the simulator has stayed behind the surface for too long. Call it with every topology of the
  /// simulator.
  bool isOverdue(std::uint32_t surface_revision, std::uint32_t simulator_revision);

 private:
  /// The simulator sends topologies of a revision before the surface's.
  struct Lag {
    ros::WallTime since;
    std::uint32_t simulator_revision;
  };

  std::string body_frame_;
  softbody_msgs::CutHistoryConstPtr edits_;  ///< as published
  std::optional<std::uint32_t> pending_;     ///< revision
  std::optional<Lag> lag_;
  ros::Publisher cut_publisher_, edits_publisher_;
};

}  // namespace softbody
