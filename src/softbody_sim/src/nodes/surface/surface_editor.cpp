#include "nodes/surface/surface_editor.h"

#include <stdexcept>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/topics.h"

namespace softbody {

SurfaceEditor::SurfaceEditor(ros::NodeHandle node, const std::string& body_frame, const CuttingConfig& config,
                             std::function<void()> on_cut)
    : config_(config),
      on_cut_(std::move(on_cut)),
      cuts_(node, body_frame),
      blade_(node, [this](const Points& polygon, const ros::Time& stamp) { onBlade(polygon, stamp); }) {
  cut_subscriber_ = node.subscribe(topics::kCut, 20, &SurfaceEditor::onRecordedCut, this,
                                   ros::TransportHints().tcpNoDelay());
}

void SurfaceEditor::start(const MeshTopology& visual, const TetTopology& volume) {
  body_ = CuttableSurface(visual, volume, config_);
  start_vertices_ = visual.rest_vertices;
  state_.reset();
  blade_.reset();
  cuts_.reset();
}

void SurfaceEditor::onState(const MeshState& state, const std_msgs::Header& header) {
  state_ = state;
  state_stamp_ = header.stamp;
  cuts_.confirm(state.revision);
  if (body_) body_->confirm(state.revision);
  blade_.onState(header);
  tear();
}

void SurfaceEditor::onBlade(const Points& polygon, const ros::Time& stamp) {
  if (!body_ || !state_) return;
  try {
    if (polygon.rows() < 3 || !polygon.allFinite())
      throw std::invalid_argument("it needs at least three corners, all finite");
    const std::optional<Cut> cut = body_->follow(polygon, *state_, toNanoseconds(stamp));
    if (cut) publish(*cut, stamp);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the blade cannot cut: " << error.what());
  }
}

void SurfaceEditor::tear() {
  if (!body_) return;
  try {
    const std::optional<Cut> cut = body_->tear(*state_);
    if (!cut) return;
    ROS_INFO("the body tears: revision %u", cut->revision);
    publish(*cut, state_stamp_);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the body cannot tear: " << error.what());
  }
}

void SurfaceEditor::publish(const Cut& cut, const ros::Time& stamp) {
  cuts_.publish(cut, stamp);
  on_cut_();
}

void SurfaceEditor::onVolumeTopology(std::uint32_t revision) {
  if (!state_) cuts_.confirm(revision);  // a body that is not placed has no states that confirm
  const std::uint32_t own_revision = body_ ? body_->volume().revision : 0;
  if (cuts_.isOverdue(own_revision, revision)) return rollBack(revision);
  cuts_.resend(revision);
}

/// The simulator refused the cut, or failed. Without a roll-back no further cut would be possible.
void SurfaceEditor::rollBack(std::uint32_t volume_revision) {
  const std::uint32_t revision = body_->volume().revision;
  if (!body_->rollBack(volume_revision)) return;  // another body: it starts with its topology
  cuts_.reset();
  ROS_ERROR(
      "the simulator stays at revision %u and does not make the cut of revision %u: the surface takes it "
      "back",
      volume_revision, revision);
}

/// Also receives the own cuts, which are already made.
void SurfaceEditor::onRecordedCut(const softbody_msgs::CutConstPtr& message) {
  if (!body_ || message->revision <= body_->volume().revision) return;
  std::string reason;
  try {
    if (body_->apply(fromMessage(*message), stateOrRest(), &reason)) {
      on_cut_();
      return;
    }
  } catch (const std::exception& error) {
    reason = error.what();
  }
  ROS_WARN_STREAM("the cut of revision " << message->revision << " is not made: " << reason);
}

/// The last state if it has the present revision, otherwise the rest shape.
MeshState SurfaceEditor::stateOrRest() const {
  const TetTopology& volume = body_->volume();
  if (state_ && state_->revision == volume.revision && state_->vertices.rows() == volume.rest_vertices.rows())
    return *state_;
  MeshState rest;
  rest.revision = volume.revision;
  rest.vertices = volume.rest_vertices;
  rest.confidence.assign(static_cast<std::size_t>(rest.vertices.rows()), 0.0f);
  return rest;
}

bool SurfaceEditor::isReady(std::string* reason) const {
  if (!body_)
    *reason = "the volume's topology has not come yet";
  else if (cuts_.isPending())
    *reason = "an earlier cut is still on its way";
  else
    return true;
  return false;
}

bool SurfaceEditor::apply(const Cut& cut, std::string* reason) {
  if (!body_->apply(cut, stateOrRest(), reason)) return false;
  reason->clear();
  publish(cut, state_ ? state_stamp_ : ros::Time());
  return true;
}

}  // namespace softbody
