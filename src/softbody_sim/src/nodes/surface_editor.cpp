#include "nodes/surface_editor.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/rigid_fit.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/topics.h"
#include "softbody_sim/cutting/cut_shapes.h"

namespace softbody {
namespace {

/// Further apart in time the blade and the body's state say nothing of each other.
constexpr double kSameInstant = 0.1;  // [s]
/// The body's states come later than blades, on a slow machine by many frames; later than this they will not.
constexpr double kLongestWait = 5.0;        // [s]
constexpr std::size_t kMostWaiting = 5000;  // bounds memory, whatever the stamps are
constexpr int kBladeQueue = 100;            // of a fast tool, while a cut is made
/// As many blades without a state are no bag that starts again.
constexpr int kMostLeftOut = 5;
/// A simulator that goes on for so long without a cut will not make it.
constexpr double kLongestBehind = 3.0;  // [s]

}  // namespace

SurfaceEditor::SurfaceEditor(const ros::NodeHandle& node, ros::NodeHandle private_node,
                             std::string body_frame, const CuttingConfig& config,
                             std::function<void()> on_cut, std::function<void(const CutPreview&)> on_preview)
    : node_(node),
      body_frame_(std::move(body_frame)),
      config_(config),
      on_cut_(std::move(on_cut)),
      on_preview_(std::move(on_preview)) {
  cut_publisher_ = node_.advertise<softbody_msgs::Cut>(topics::kCut, 20);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  blade_subscriber_ = node_.subscribe(topics::kToolBlade, kBladeQueue, &SurfaceEditor::onBlade, this, hints);
  cut_subscriber_ = node_.subscribe(topics::kCut, 20, &SurfaceEditor::onCut, this, hints);
  cut_service_ = private_node.advertiseService("cut", &SurfaceEditor::onCutService, this);
  preview_service_ = private_node.advertiseService("preview", &SurfaceEditor::onPreview, this);
  const auto edit = [&](const char* name, CutKind kind) {
    using Trigger = std_srvs::Trigger;
    return private_node.advertiseService<Trigger::Request, Trigger::Response>(
        name,
        [this, kind](Trigger::Request&, Trigger::Response& response) { return onEdit(kind, response); });
  };
  undo_service_ = edit("undo", CutKind::kUndo);
  redo_service_ = edit("redo", CutKind::kRedo);
  reset_service_ = edit("reset", CutKind::kReset);
}

void SurfaceEditor::start(const MeshTopology& visual, const TetTopology& volume) {
  body_ = CuttableSurface(visual, volume, config_);  // the one before stays where this throws
  rest_ = visual.rest_vertices;
  state_.reset();
  waiting_blades_.clear();
  last_cut_.reset();
  behind_.reset();
}

void SurfaceEditor::onState(const MeshState& state, const std_msgs::Header& header) {
  state_ = state;
  state_header_ = header;
  if (last_cut_ && last_cut_->revision <= state.revision) last_cut_.reset();
  if (body_) body_->confirm(state.revision);
  geometry_msgs::PolygonStampedConstPtr blade;  // the last one up to the state
  while (!waiting_blades_.empty() && waiting_blades_.front()->header.stamp <= header.stamp) {
    blade = waiting_blades_.front();
    waiting_blades_.pop_front();
  }
  if (blade) follow(*blade);
  tear();
}

void SurfaceEditor::onBlade(const geometry_msgs::PolygonStampedConstPtr& message) {
  const ros::Time& stamp = message->header.stamp;
  if (!waiting_blades_.empty() && stamp < waiting_blades_.back()->header.stamp) waiting_blades_.clear();
  if (state_ && stamp <= state_header_.stamp) return follow(*message);
  waiting_blades_.push_back(message);
  while ((stamp - waiting_blades_.front()->header.stamp).toSec() > kLongestWait ||
         waiting_blades_.size() > kMostWaiting) {
    leaveOut(*waiting_blades_.front());
    waiting_blades_.pop_front();
  }
}

void SurfaceEditor::leaveOut(const geometry_msgs::PolygonStamped& blade) {
  if (!state_ || ++left_out_ < kMostLeftOut) return;
  const double ahead = (blade.header.stamp - state_header_.stamp).toSec();
  ROS_WARN_STREAM_THROTTLE(
      5.0, fmt::format("the blade cannot cut: it is of {:.3f} s, {:.3f} s {} the body's last state; a blade "
                       "needs the stamp of an image that the body is followed in",
                       blade.header.stamp.toSec(), std::abs(ahead), ahead > 0.0 ? "ahead of" : "behind"));
}

void SurfaceEditor::follow(const geometry_msgs::PolygonStamped& blade) {
  if (!body_ || !state_) return;
  if (std::abs((state_header_.stamp - blade.header.stamp).toSec()) > kSameInstant) return leaveOut(blade);
  left_out_ = 0;
  const std::optional<Points> polygon = inStatesFrame(blade);
  if (!polygon) return;
  try {
    if (polygon->rows() < 3 || !polygon->allFinite())
      throw std::invalid_argument("it needs three corners or more, all finite");
    const std::optional<Cut> cut = body_->follow(*polygon, *state_, toNanoseconds(blade.header.stamp));
    if (cut) publish(*cut, blade.header.stamp);
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
    publish(*cut, state_header_.stamp);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the body cannot tear: " << error.what());
  }
}

std::optional<Points> SurfaceEditor::inStatesFrame(const geometry_msgs::PolygonStamped& blade) {
  Points points = fromMessage(blade.polygon);
  if (blade.header.frame_id == state_header_.frame_id) return points;
  if (!listener_) listener_ = std::make_unique<tf2_ros::TransformListener>(buffer_);
  try {
    const Eigen::Isometry3d T(
        tf2::transformToEigen(
            buffer_.lookupTransform(state_header_.frame_id, blade.header.frame_id, blade.header.stamp))
            .matrix());
    return transformed(points, T);
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the blade's place is not known: " << error.what());
    return std::nullopt;
  }
}

void SurfaceEditor::publish(const Cut& cut, const ros::Time& stamp) {
  last_cut_ = boost::make_shared<softbody_msgs::Cut>(toMessage(cut));
  last_cut_->header.stamp = stamp;
  last_cut_->header.frame_id = body_frame_;
  cut_publisher_.publish(last_cut_);
  on_cut_();
}

void SurfaceEditor::resendTo(std::uint32_t volume_revision) {
  // A body without a place has no state to tell it.
  if (last_cut_ && !state_ && last_cut_->revision <= volume_revision) last_cut_.reset();
  if (isStuckAt(volume_revision)) return rollBack(volume_revision);
  if (!last_cut_ || last_cut_->revision != volume_revision + 1) return;
  ROS_WARN("the simulator has not made the cut of revision %u; it is sent again", last_cut_->revision);
  cut_publisher_.publish(boost::make_shared<softbody_msgs::Cut>(*last_cut_));
}

bool SurfaceEditor::isStuckAt(std::uint32_t volume_revision) {
  if (!body_ || body_->volume().revision <= volume_revision) {
    behind_.reset();
    return false;
  }
  const ros::WallTime now = ros::WallTime::now();
  if (!behind_ || behind_->second != volume_revision) behind_.emplace(now, volume_revision);
  return (now - behind_->first).toSec() > kLongestBehind;
}

/// The simulator refused the cut, or failed: until it is taken back here nothing can be cut any more.
void SurfaceEditor::rollBack(std::uint32_t volume_revision) {
  const std::uint32_t revision = body_->volume().revision;
  if (!body_->rollBack(volume_revision)) return;  // another body, which starts with its topology
  last_cut_.reset();
  behind_.reset();
  ROS_ERROR(
      "the simulator stays at revision %u and does not make the cut of revision %u: the surface takes it "
      "back",
      volume_revision, revision);
}

/// Recorded cuts that are played, and one's own, which are done already.
void SurfaceEditor::onCut(const softbody_msgs::CutConstPtr& message) {
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

/// The last state where it is of the present revision; before the body is placed, the rest shape.
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

bool SurfaceEditor::isIdle(std::string* reason) const {
  if (!body_)
    *reason = "the volume's topology has not come yet";
  else if (last_cut_)
    *reason = "an earlier cut is still on its way";
  else
    return true;
  return false;
}

template <typename Request>
TriangleMesh SurfaceEditor::patchOf(const Request& request) const {
  if (!request.header.frame_id.empty() && request.header.frame_id != body_frame_) {
    throw std::invalid_argument(fmt::format("frame_id is {}, but cuts are made in the rest frame, {}",
                                            request.header.frame_id, body_frame_));
  }
  if (request.polygon.empty()) {
    return planePatch({request.point.x, request.point.y, request.point.z},
                      {request.normal.x, request.normal.y, request.normal.z}, rest_);
  }
  Points corners(static_cast<Eigen::Index>(request.polygon.size()), 3);
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const geometry_msgs::Point32& p = request.polygon[static_cast<std::size_t>(i)];
    corners.row(i) << p.x, p.y, p.z;
  }
  return polygonPatch(corners);
}

bool SurfaceEditor::onCutService(softbody_msgs::CutBody::Request& request,
                                 softbody_msgs::CutBody::Response& response) {
  try {
    response.success = static_cast<unsigned char>(
        isIdle(&response.message) && apply(body_->separateCut(patchOf(request)), &response.message));
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  if (body_) response.revision = body_->volume().revision;
  return true;
}

bool SurfaceEditor::onPreview(softbody_msgs::PreviewCut::Request& request,
                              softbody_msgs::PreviewCut::Response& response) {
  try {
    if (!isIdle(&response.message)) return true;
    const CutPreview preview = body_->preview(patchOf(request));
    response.success = static_cast<unsigned char>(preview.refusal.empty());
    response.message = preview.refusal;
    response.volumes = preview.volumes;
    on_preview_(preview);
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  return true;
}

bool SurfaceEditor::onEdit(CutKind kind, std_srvs::Trigger::Response& response) {
  response.success =
      static_cast<unsigned char>(isIdle(&response.message) && apply(body_->edit(kind), &response.message));
  return true;
}

bool SurfaceEditor::apply(const Cut& cut, std::string* reason) {
  if (!body_->apply(cut, stateOrRest(), reason)) return false;
  reason->clear();
  publish(cut, state_ ? state_header_.stamp : ros::Time());
  return true;
}

}  // namespace softbody
