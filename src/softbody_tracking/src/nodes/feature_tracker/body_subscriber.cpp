#include "nodes/feature_tracker/body_subscriber.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"

namespace softbody {
namespace {

void checkVertexCount(const MeshState& state, const TetTopology& topology) {
  if (topology.revision != state.revision || topology.rest_vertices.rows() == state.vertices.rows()) return;
  throw std::invalid_argument(std::to_string(state.vertices.rows()) + " vertices, but the topology has " +
                              std::to_string(topology.rest_vertices.rows()));
}

}  // namespace

BodySubscriber::BodySubscriber(ros::NodeHandle handle, BodyTracker* tracker) : tracker_(tracker) {
  volume_subscriber_ = handle.subscribe(topics::kVolumeTopology, 1, &BodySubscriber::onVolumeTopology, this);
  surface_subscriber_ =
      handle.subscribe(topics::kSurfaceTopology, 1, &BodySubscriber::onSurfaceTopology, this);
  state_subscriber_ = handle.subscribe(topics::kVolumeState, 1, &BodySubscriber::onState, this);
}

void BodySubscriber::onVolumeTopology(const softbody_msgs::TetTopology::ConstPtr& message) try {
  TetTopology topology = fromMessage(*message);
  // The topology is sent again every second. Only a changed one counts.
  const bool same = volume_ && topology.revision == volume_->revision &&
                    topology.rest_vertices == volume_->rest_vertices && topology.tets == volume_->tets;
  if (same) return;
  volume_ = std::move(topology);
  adoptTopologies();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, volume_subscriber_.getTopic() << " is unusable: " << error.what());
}

void BodySubscriber::onSurfaceTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  MeshTopology topology = fromMessage(*message);
  const bool same = surface_ && topology.revision == surface_->revision &&
                    topology.rest_vertices == surface_->rest_vertices &&
                    topology.triangles == surface_->triangles;
  if (same) return;
  surface_ = std::move(topology);
  adoptTopologies();
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, surface_subscriber_.getTopic() << " is unusable: " << error.what());
}

void BodySubscriber::onState(const softbody_msgs::MeshState::ConstPtr& message) try {
  newest_state_ = message;
  if (message->revision == adopted_revision_) {
    adopted_state_ = message;
  } else {
    adoptTopologies();
  }
} catch (const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(
      5.0, "the topologies of revision " << message->revision << " are unusable: " << error.what());
}

/// Gives the tracker both topologies when their revisions are equal. After an edit it also waits for the
/// first state of the new revision, unless no state has come at all.
void BodySubscriber::adoptTopologies() {
  if (!volume_ || !surface_) return;
  const std::uint32_t revision = volume_->revision;
  if (surface_->revision != revision) return;
  const bool edited = tracker_->ready() && revision > adopted_revision_;
  if (edited && newest_state_ && newest_state_->revision != revision) return;
  tracker_->setTopologies(*volume_, *surface_);
  adopted_revision_ = revision;
  adopted_state_ = edited ? newest_state_ : nullptr;
}

std::optional<MeshState> BodySubscriber::state() const try {
  if (!adopted_state_) return std::nullopt;
  MeshState state = fromMessage(*adopted_state_);
  if (volume_) checkVertexCount(state, *volume_);
  return state;
} catch (const std::invalid_argument& error) {
  ROS_ERROR_STREAM_THROTTLE(5.0, state_subscriber_.getTopic() << " is unusable: " << error.what());
  return std::nullopt;
}

void BodySubscriber::clearStates() {
  adopted_state_.reset();
  newest_state_.reset();
}

}  // namespace softbody
