#include "nodes/feature_tracker/body_subscriber.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"

namespace softbody {
namespace {

void requireVertexCount(const MeshState& state, const TetTopology& topology) {
  if (topology.revision != state.revision || topology.rest_vertices.rows() == state.vertices.rows()) return;
  throw std::invalid_argument(std::to_string(state.vertices.rows()) + " vertices, but the topology has " +
                              std::to_string(topology.rest_vertices.rows()));
}

}  // namespace

BodySubscriber::BodySubscriber(ros::NodeHandle handle, BodyTracker* tracker,
                               std::function<void()> on_other_body)
    : stamps_(handle.resolveName(topics::kVolumeState), StampGate::Repeats::kAccepted),
      tracker_(tracker),
      on_other_body_(std::move(on_other_body)) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  volume_subscriber_ =
      handle.subscribe(topics::kVolumeTopology, 1, &BodySubscriber::onVolumeTopology, this, hints);
  surface_subscriber_ =
      handle.subscribe(topics::kSurfaceTopology, 1, &BodySubscriber::onSurfaceTopology, this, hints);
  state_subscriber_ = handle.subscribe(topics::kVolumeState, 1, &BodySubscriber::onState, this, hints);
}

/// A topology that the tracker refuses is forgotten.
template <typename Topology>
void BodySubscriber::adopt(Topology received, std::optional<Topology>* newest) {
  std::optional<Topology> before = std::exchange(*newest, std::move(received));
  try {
    adoptTopologies();
  } catch (const std::exception&) {
    *newest = std::move(before);
    throw;
  }
}

void BodySubscriber::onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message) try {
  // The topology is sent again every second. Only a changed one counts.
  std::optional<Volume> changed;
  if (!volume_ || !sameTopology(*volume_->message, *message))
    changed = Volume{message, fromMessage(*message)};
  // A simulator whose body is not placed has no state: those that came are of an earlier simulation.
  const bool is_placed = !message->header.stamp.isZero();
  if (!is_placed) clearStates();
  if (changed)
    adopt(std::move(*changed), &volume_);
  else if (!is_placed)
    adoptTopologies();  // which may have waited for a state that never comes
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, volume_subscriber_.getTopic() << " is unusable: " << error.what());
}

void BodySubscriber::onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  if (surface_ && sameTopology(*surface_->message, *message)) return;
  adopt(Surface{message, fromMessage(*message)}, &surface_);
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, surface_subscriber_.getTopic() << " is unusable: " << error.what());
}

void BodySubscriber::onState(const softbody_msgs::MeshState::ConstPtr& message) try {
  PlacedState state{withoutSlash(message->header.frame_id), fromMessage(*message)};
  if (volume_) requireVertexCount(state.mesh, volume_->topology);
  // Without an image the simulator goes on: its states then belong to the image of the last one.
  if (!stamps_.admits(stampOfImage(*message))) return;
  newest_state_ = std::move(state);
  if (adopted_volume_ && message->revision == adopted_volume_->revision)
    adopted_state_ = newest_state_;
  else
    adoptTopologies();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, state_subscriber_.getTopic()
                                     << " of revision " << message->revision
                                     << " is not used: " << error.what() << "; rostopic info "
                                     << state_subscriber_.getTopic() << " names the sender");
}

/// Gives the tracker both topologies when their revisions are equal. After an edit it also waits for the
/// first state of the new revision, unless no state has come at all.
void BodySubscriber::adoptTopologies() {
  if (!volume_ || !surface_) return;
  if (volume_->message == adopted_volume_ && surface_->message == adopted_surface_) return;
  const std::uint32_t revision = volume_->topology.revision;
  if (surface_->topology.revision != revision) return;
  const bool edited = tracker_->isEdit(volume_->topology, surface_->topology);
  if (edited && newest_state_ && newest_state_->mesh.revision != revision) return;
  if (!edited) on_other_body_();
  tracker_->setTopologies(volume_->topology, surface_->topology);
  adopted_volume_ = volume_->message;
  adopted_surface_ = surface_->message;
  adopted_state_ = edited ? newest_state_ : std::nullopt;
}

const MeshState* BodySubscriber::state(const std::string& frame_id) const {
  if (!adopted_state_) return nullptr;
  if (adopted_state_->frame_id == frame_id) return &adopted_state_->mesh;
  ROS_WARN_STREAM_THROTTLE(5.0, state_subscriber_.getTopic() << " is in frame '" << adopted_state_->frame_id
                                                             << "', but the body is tracked in '" << frame_id
                                                             << "': the body is placed again");
  return nullptr;
}

void BodySubscriber::clearStates() {
  adopted_state_.reset();
  newest_state_.reset();
}

}  // namespace softbody
