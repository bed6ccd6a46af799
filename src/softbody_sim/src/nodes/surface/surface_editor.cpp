#include "nodes/surface/surface_editor.h"

#include <malloc.h>

#include <boost/make_shared.hpp>
#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr std::size_t kMostRecordedCuts = 100;  // that wait
/// A simulator that publishes without the cut for this long will not make it.
constexpr double kLongestLag = 3.0;  // [s]

}  // namespace

SurfaceEditor::SurfaceEditor(ros::NodeHandle node, const std::string& body_frame, ObjectVisual* visual,
                             const CuttingConfig& config, std::function<void()> on_edit)
    : body_frame_(body_frame),
      visual_(visual),
      config_(config),
      on_edit_(std::move(on_edit)),
      cut_publisher_(node.advertise<softbody_msgs::Cut>(topics::kCut, 20)),
      edits_publisher_(node.advertise<softbody_msgs::CutHistory>(topics::kSurfaceCuts, 1, true)),
      blade_(node, [this](const Points& polygon, const ros::Time& stamp) { onBlade(polygon, stamp); }) {
  if (config.tear_strain > 0.0) targets_.emplace(node);
  cut_subscriber_ = node.subscribe(topics::kCut, 20, &SurfaceEditor::onRecordedCut, this,
                                   ros::TransportHints().tcpNoDelay());
}

void SurfaceEditor::start(const TetTopology& volume) {
  visual_->update();
  body_.emplace(uncutBody(volume));
  resetInputs();
  publishEdits({}, false);
}

CuttableBody SurfaceEditor::uncutBody(const TetTopology& volume) const {
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
  noteSimulator(state.revision);
  makeRecordedCuts();
  blade_.onState(header);
  tear();
}

void SurfaceEditor::noteSimulator(std::uint32_t revision) {
  if (body_ && revision >= body_->volume().revision) pending_ = false;
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
  const auto message = boost::make_shared<softbody_msgs::Cut>(toMessage(cut));
  message->header.stamp = stamp;
  message->header.frame_id = body_frame_;
  cut_publisher_.publish(message);
  finishEdit(stamp);
}

/// The edits are latched. @param pending the simulator has to follow.
void SurfaceEditor::publishEdits(const ros::Time& stamp, bool pending) {
  edits_publisher_.publish(historyMessage(body_->edits(), body_->uncutVolume(), body_frame_, stamp));
  pending_ = pending;
  behind_since_.reset();
}

void SurfaceEditor::finishEdit(const ros::Time& stamp) {
  if (body_->edits().body == 0) body_->setBody(ros::WallTime::now().toNSec());
  publishEdits(stamp, true);
  malloc_trim(0);  // returns the memory of dropped versions
  if (body_->droppedVersions() > 0) {
    ROS_INFO_ONCE(
        "the memory of earlier cuts is full: undo of the oldest strokes will take longer, because the body "
        "is cut again");
  }
  on_edit_();
}

bool SurfaceEditor::onVolumeTopology(std::uint32_t revision) {
  if (!state_) noteSimulator(revision);  // a body that is not placed has no states
  makeRecordedCuts();
  const ros::WallTime now = ros::WallTime::now();
  const bool is_behind = body_ && revision < body_->volume().revision;
  behind_since_ = is_behind ? behind_since_.value_or(now) : std::optional<ros::WallTime>();
  return !is_behind || (now - *behind_since_).toSec() <= kLongestLag || takeBack(revision);
}

/// The simulator refused the cut, or failed. Otherwise no further cut would be possible.
/// @return false if the surface has never been at this revision: the simulator has another body.
bool SurfaceEditor::takeBack(std::uint32_t simulator_revision) {
  const std::uint32_t revision = body_->volume().revision;
  body_->takeBack();
  if (body_->volume().revision != simulator_revision) return false;
  publishEdits(state_header_.stamp, false);
  ROS_ERROR(
      "the simulator stays at revision %u and does not make the cut of revision %u: the surface takes it "
      "back",
      simulator_revision, revision);
  return true;
}

/// A simulator that has just started takes over the edits of the surface, if there are any. Otherwise the
/// simulator is right. An edit that it has not made yet is on its way.
void SurfaceEditor::onVolumeEdits(const EditedBody& theirs) {
  static const EditHistory kNone;
  const EditHistory& own = body_ ? body_->edits() : kNone;
  const std::string refusal = refusalOf(theirs.edits, own);
  if (!refusal.empty()) throw std::invalid_argument(refusal);
  if (!body_) return adopt(theirs);
  if (theirs.edits.body == 0 && own.body != 0) return;
  const bool same_body = theirs.edits.body == own.body && sameRestBody(body_->uncutVolume(), theirs.uncut);
  if (same_body && theirs.edits.revision < own.revision) return;
  if (same_body && theirs.edits.revision == own.revision && sameEdits(theirs.edits, own)) return;
  adopt(theirs);
}

void SurfaceEditor::adopt(const EditedBody& theirs) {
  bool same_rest = body_ && sameRestBody(body_->uncutVolume(), theirs.uncut);
  const bool same_body = same_rest && body_->edits().body == theirs.edits.body;
  if (!same_body && visual_->update()) same_rest = false;
  if (same_rest) {
    body_->adopt(theirs.edits);
  } else {
    CuttableBody body = uncutBody(theirs.uncut);
    body.adopt(theirs.edits);
    body_.emplace(std::move(body));
  }
  if (!same_body) resetInputs();
  publishEdits({}, false);
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
  while (body_ && !pending_ && !recorded_cuts_.empty()) {
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
  else if (pending_)
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
