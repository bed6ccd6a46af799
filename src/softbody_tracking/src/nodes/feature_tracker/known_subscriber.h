#pragma once

#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/ros/stamp_gate.h"
#include "softbody_tracking/known/followed_surface.h"

namespace softbody {

/// Receives the surface of another tracked body, from X/topology and X/state.
class KnownSubscriber {
 public:
  /// Pose of a header's frame in the fixed frame, at its stamp. Throws tf2::TransformException if tf does not
  /// know it.
  using PoseLookup = std::function<Eigen::Isometry3d(const std_msgs::Header& header)>;

  /// @param surface name of the topics' namespace, e.g. "/doll/surface".
  KnownSubscriber(ros::NodeHandle handle, const std::string& surface, PoseLookup look_up);

  /// The surface in the camera's frame; nothing while no state is at hand, or tf does not know its place.
  /// @param frame for its stamp and the camera's pose.
  std::optional<KnownSurface> at(const RgbdFrame& frame);

  /// Time has jumped back.
  void clearStates() { surface_.forgetStates(); }

 private:
  void onTopology(const softbody_msgs::MeshTopology::ConstPtr& message);
  void onState(const softbody_msgs::MeshState::ConstPtr& message);
  void warnIfAbsent() const;

  FollowedSurface surface_;
  softbody_msgs::MeshTopology::ConstPtr topology_;  ///< that the surface has
  PoseLookup look_up_;
  StampGate stamps_;         ///< of the states
  std_msgs::Header header_;  ///< of the newest state
  ros::SteadyTime start_ = ros::SteadyTime::now();
  ros::Subscriber topology_subscriber_, state_subscriber_;
};

/// Subscribers of other surfaces. @param surfaces the parameter `known_surfaces`: namespaces of topics, or
/// their topics.
/// @throw std::invalid_argument for a name that no topic can have, and for the body's own surface.
std::vector<std::unique_ptr<KnownSubscriber>> subscribeToKnown(const ros::NodeHandle& handle,
                                                               const std::vector<std::string>& surfaces,
                                                               const KnownSubscriber::PoseLookup& look_up);

}  // namespace softbody
