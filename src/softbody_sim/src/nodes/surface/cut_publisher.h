#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Cut.h>

#include <cstdint>
#include <optional>
#include <string>

#include "softbody_common/cut.h"

namespace softbody {

/// Sends cuts to the simulator, one at a time. A cut is pending until the simulator's revision shows that it
/// is made.
class CutPublisher {
 public:
  CutPublisher(ros::NodeHandle node, std::string body_frame);

  void publish(const Cut& cut, const ros::Time& stamp);
  bool isPending() const { return pending_ != nullptr; }
  /// The simulator has reached a revision.
  void confirm(std::uint32_t revision);
  /// Sends the pending cut again if the simulator is one revision behind it.
  void resend(std::uint32_t simulator_revision);
  /// Whether the simulator has stayed behind the surface for too long. Call it with every topology of the
  /// simulator.
  bool isOverdue(std::uint32_t surface_revision, std::uint32_t simulator_revision);
  /// Forgets the pending cut.
  void reset();

 private:
  /// The simulator sends topologies of a revision before the surface's.
  struct Lag {
    ros::WallTime since;
    std::uint32_t simulator_revision;
  };

  std::string body_frame_;
  softbody_msgs::CutPtr pending_;
  std::optional<Lag> lag_;
  ros::Publisher publisher_;
};

}  // namespace softbody
