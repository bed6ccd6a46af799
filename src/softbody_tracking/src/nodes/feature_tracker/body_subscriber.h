#pragma once

#include <ros/ros.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/TetTopology.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "softbody_common/ros/stamp_gate.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {

/// Receives the simulated body: the topologies of volume and surface, which it gives to the tracker, and the
/// state.
class BodySubscriber {
 public:
  /// @param tracker must outlive this. @param on_other_body called before the tracker gets its first body, or
  /// another one.
  BodySubscriber(ros::NodeHandle handle, BodyTracker* tracker, std::function<void()> on_other_body);

  /// The newest state with the tracker's topology; nullptr before the first one, if it is in another frame,
  /// and when the simulator has started again.
  const MeshState* state(const std::string& frame_id) const;

  /// Forgets all states, for when time has jumped back.
  void clearStates();

 private:
  struct PlacedState {
    std::string frame_id;
    MeshState mesh;
  };

  /// A topology, and the message that it was converted from.
  template <typename Topology, typename Message>
  struct Received {
    boost::shared_ptr<const Message> message;
    Topology topology;
  };
  using Volume = Received<TetTopology, softbody_msgs::TetTopology>;
  using Surface = Received<MeshTopology, softbody_msgs::MeshTopology>;

  void onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message);
  void onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message);
  void onState(const softbody_msgs::MeshState::ConstPtr& message);
  void adoptTopologies();
  template <typename Topology>
  void adopt(Topology received, std::optional<Topology>* newest);

  StampGate stamps_;  ///< of the states
  BodyTracker* tracker_;
  std::function<void()> on_other_body_;
  std::optional<Volume> volume_;                             ///< newest topology
  std::optional<Surface> surface_;                           ///< newest topology
  softbody_msgs::TetTopology::ConstPtr adopted_volume_;      ///< the tracker's; null: none
  softbody_msgs::MeshTopology::ConstPtr adopted_surface_;    ///< likewise
  std::optional<PlacedState> newest_state_, adopted_state_;  ///< of any, and of the adopted revision
  ros::Subscriber volume_subscriber_, surface_subscriber_, state_subscriber_;
};

}  // namespace softbody
