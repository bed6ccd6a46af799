#include "nodes/surface/surface_editor.h"

#include <malloc.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr std::size_t kMostRecordedCuts = 100;  // that wait

}  // namespace

SurfaceEditor::SurfaceEditor(ros::NodeHandle node, const std::string& body_frame, ObjectVisual* visual,
                             const CuttingConfig& config, std::function<void()> on_edit)
    : visual_(visual),
      config_(config),
      on_edit_(std::move(on_edit)),
      cuts_(node, body_frame),
      blade_(node, [this](const Points& polygon, const ros::Time& stamp) { onBlade(polygon, stamp); }) {
  if (config.tear_strain > 0.0) targets_.emplace(node);
  cut_subscriber_ = node.subscribe(topics::kCut, 20, &SurfaceEditor::onRecordedCut, this,
                                   ros::TransportHints().tcpNoDelay());
}

void SurfaceEditor::start(const TetTopology& volume) {
  visual_->update();
  body_.emplace(uncutSurface(volume));
  resetInputs();
  cuts_.publishEdits(*body_, {}, false);
}

CuttableSurface SurfaceEditor::uncutSurface(const TetTopology& volume) const {
  MeshTopology visual = visual_->mesh();
  visual.revision = volume.revision;
  return {visual, volume, config_};
}

/// What waits belongs to an earlier body.
void SurfaceEditor::resetInputs() {
  state_.reset();
  blade_.reset();
  recorded_cuts_.clear();
}

void SurfaceEditor::onState(const MeshState& state, const std_msgs::Header& header) {
  state_ = state;
  state_header_ = header;
  confirm(state.revision);
  makeRecordedCuts();
  blade_.onState(header);
  tear();
}

void SurfaceEditor::confirm(std::uint32_t revision) {
  cuts_.confirm(revision);
  if (body_) body_->confirm(revision);
}

void SurfaceEditor::onBlade(const Points& polygon, const ros::Time& stamp) {
  if (!body_ || !state_) return;
  try {
    const std::optional<Cut> cut = body_->follow(polygon, *state_, toNanoseconds(stamp));
    if (cut) publish(*cut, stamp);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the blade cannot cut: " << error.what());
  }
}

void SurfaceEditor::tear() {
  if (!body_ || !state_) return;
  try {
    const std::optional<Cut> cut = body_->tear(*state_, targets_ ? targets_->of(state_header_) : TargetSet());
    if (!cut) return;
    ROS_INFO("the body tears: revision %u", cut->revision);
    publish(*cut, state_header_.stamp);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the body cannot tear: " << error.what());
  }
}

void SurfaceEditor::publish(const Cut& cut, const ros::Time& stamp) {
  cuts_.publish(cut, stamp);
  finishEdit(stamp);
}

void SurfaceEditor::finishEdit(const ros::Time& stamp) {
  if (body_->edits().body == 0) body_->setBody(ros::WallTime::now().toNSec());
  cuts_.publishEdits(*body_, stamp, true);
  malloc_trim(0);  // returns the memory of dropped versions
  if (body_->droppedVersions() > 0) {
    ROS_INFO_ONCE(
        "undo_memory_mb is full: undo of the oldest strokes will take longer, because the body is "
        "cut again");
  }
  on_edit_();
}

bool SurfaceEditor::onVolumeTopology(std::uint32_t revision) {
  if (!state_) confirm(revision);  // a body that is not placed has no states that confirm
  makeRecordedCuts();
  const std::uint32_t own_revision = body_ ? body_->volume().revision : 0;
  if (cuts_.isOverdue(own_revision, revision)) return rollBack(revision);
  cuts_.resend(revision);
  return true;
}

/// The simulator refused the cut, or failed. Without a roll-back no further cut would be possible.
/// @return false if the surface has never been at this revision: the simulator has another body.
bool SurfaceEditor::rollBack(std::uint32_t volume_revision) {
  const std::uint32_t revision = body_->volume().revision;
  if (!body_->rollBack(volume_revision)) return false;
  cuts_.publishEdits(*body_, state_header_.stamp, false);
  ROS_ERROR(
      "the simulator stays at revision %u and does not make the cut of revision %u: the surface takes it "
      "back",
      volume_revision, revision);
  return true;
}

/// A simulator that has just started takes over the edits of the surface. Otherwise the simulator is right.
/// An edit that it has not made yet is on its way.
void SurfaceEditor::onVolumeEdits(const EditedBody& theirs) {
  static const EditHistory kNone;
  const EditHistory& own = body_ ? body_->edits() : kNone;
  const std::string refusal = refusalOf(theirs.edits, own);
  if (!refusal.empty()) throw std::invalid_argument(refusal);
  if (!body_) return adopt(theirs);
  if (theirs.edits.body == 0) return;
  const bool same_body = theirs.edits.body == own.body;
  if (same_body && theirs.edits.revision < own.revision) return;
  if (same_body && theirs.edits.revision == own.revision && sameEdits(theirs.edits, own)) return;
  adopt(theirs);
}

void SurfaceEditor::adopt(const EditedBody& theirs) {
  const bool other_visual = (!body_ || body_->edits().body != theirs.edits.body) && visual_->update();
  const bool same_rest = body_ && !other_visual && sameRestBody(body_->uncutVolume(), theirs.uncut);
  const bool same_body = same_rest && body_->edits().body == theirs.edits.body;
  if (same_rest) {
    body_->adopt(theirs.edits);
  } else {
    CuttableSurface body = uncutSurface(theirs.uncut);
    body.adopt(theirs.edits);
    body_.emplace(std::move(body));
  }
  if (!same_body) resetInputs();
  cuts_.publishEdits(*body_, {}, false);
  if (theirs.edits.revision > 0) {
    ROS_INFO("taken over from the simulator: revision %u with %zu strokes of cuts", theirs.edits.revision,
             theirs.edits.in_force);
  }
}

/// Also receives the own cuts, which are already made.
void SurfaceEditor::onRecordedCut(const softbody_msgs::CutConstPtr& message) {
  if (!body_ || message->revision <= body_->volume().revision) return;
  if (recorded_cuts_.size() >= kMostRecordedCuts) {
    ROS_WARN_THROTTLE(1.0,
                      "cuts come faster than the simulator makes them: the cut of revision %u is not made",
                      message->revision);
    return;
  }
  recorded_cuts_.push_back(message);
  makeRecordedCuts();
}

void SurfaceEditor::makeRecordedCuts() {
  while (body_ && !cuts_.isPending() && !recorded_cuts_.empty()) {
    const softbody_msgs::CutConstPtr message = recorded_cuts_.front();
    recorded_cuts_.pop_front();
    makeRecordedCut(*message);
  }
}

void SurfaceEditor::makeRecordedCut(const softbody_msgs::Cut& message) {
  if (message.revision <= body_->volume().revision) return;  // sent again
  std::string reason;
  try {
    if (body_->apply(fromMessage(message), stateOrRest(), &reason)) return finishEdit(message.header.stamp);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  ROS_WARN_STREAM("the cut of revision " << message.revision << " is not made: " << reason);
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
  publish(cut, state_ ? state_header_.stamp : ros::Time());
  return true;
}

}  // namespace softbody
