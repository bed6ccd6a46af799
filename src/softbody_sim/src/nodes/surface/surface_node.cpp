#include "nodes/surface/surface_node.h"

#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {
namespace {

/// A topology without edits that explain it after this time comes from somebody who does not publish edits.
constexpr double kLongestWaitForEdits = 0.5;  // [s]

constexpr char kStage[] = "Resolution Enhancement";

void warnOfOutside(const VisualSurface& surface) {
  if (surface.topology().revision != 0 || surface.outsideCount() == 0) return;
  ROS_WARN_ONCE("%d of %d visual vertices lie outside of the volume; they follow the nearest tet",
                surface.outsideCount(), static_cast<int>(surface.topology().rest_vertices.rows()));
}

}  // namespace

SurfaceNode::SurfaceNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : SurfaceNode(node, private_node, readSurfaceOptions(private_node)) {}

SurfaceNode::SurfaceNode(ros::NodeHandle node, const ros::NodeHandle& private_node,
                         const SurfaceOptions& options)
    : options_(options),
      visual_(private_node, options_.object, fileScope(options_.allow_outside)),
      stamps_(node.resolveName(topics::kVolumeState), StampGate::Repeats::kAccepted),
      publisher_(node),
      cut_display_(node),
      editor_(node, options_.body_frame, &visual_, options_.cutting, [this] { useWaiting(false); }),
      services_(
          private_node, options_.body_frame, &editor_,
          [this](const CutPreview& preview) { cut_display_.startPreview(preview, editor_.body().volume()); }),
      queries_(private_node, options_.save_folder),
      diagnostics_(node, private_node, options_.limits),
      live_parameters_(private_node, surfaceNodeParameters(), &options_,
                       [this](const SurfaceOptions& next) { diagnostics_.setLimits(next.limits); }) {
  edits_timeout_ = node.createWallTimer(
      ros::WallDuration(kLongestWaitForEdits),
      [this](const ros::WallTimerEvent&) {
        if (topology_subscriber_.getNumPublishers() == 0) waiting_topology_.reset();  // its sender has ended
        useWaiting(true);
      },
      true, false);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  edits_subscriber_ = node.subscribe(topics::kVolumeCuts, 1, &SurfaceNode::onVolumeEdits, this, hints);
  topology_subscriber_ = node.subscribe(topics::kVolumeTopology, 1, &SurfaceNode::onTopology, this, hints);
  state_subscriber_ = node.subscribe(topics::kVolumeState, 1, &SurfaceNode::onState, this, hints);
}

void SurfaceNode::onTopology(const softbody_msgs::TetTopologyConstPtr& message) try {
  const bool is_published = updateStamp(*message);
  if (!is_published) fromMessage(*message);  // throws if it is no topology
  const auto waited = std::exchange(waiting_topology_, nullptr);
  const bool same_body = editor_.onVolumeTopology(message->revision);
  if (same_body && is_published) return;
  if (!same_body) startBody(*message);
  waiting_topology_ = message;
  useWaiting(waited && sameTopology(*waited, *message));
} catch (const std::exception& error) {
  refuse(*message, error);
}

void SurfaceNode::refuse(const softbody_msgs::TetTopology& message, const std::exception& error) {
  ROS_ERROR_STREAM_THROTTLE(1.0, "the volume's topology of revision "
                                     << message.revision << " is not used: " << error.what()
                                     << "; rostopic info " << topology_subscriber_.getTopic()
                                     << " names the sender");
}

/// Topologies are sent again every second. @return whether this one is known; then only its stamp is new.
bool SurfaceNode::updateStamp(const softbody_msgs::TetTopology& message) {
  for (std::optional<BoundSurface>* known : {&binding_, &next_binding_}) {
    if (!*known || !sameTopology(*(*known)->volume, message)) continue;
    const bool is_new = setStamp(message.header.stamp, &**known);
    if (is_new && known == &binding_) publisher_.setTopology(binding_->topology);
    return true;
  }
  return false;
}

/// Uses the topology and the state that wait, if what they need has come.
/// @param is_late the topology has waited already.
void SurfaceNode::useWaiting(bool is_late) {
  try {
    if (waiting_topology_ && !bindWaiting(is_late)) return;
  } catch (const std::exception& error) {
    refuse(*waiting_topology_, error);
  }
  waiting_topology_.reset();
  if (const softbody_msgs::MeshStateConstPtr state = std::exchange(waiting_state_, nullptr)) useState(state);
}

/// Binds the surface to the topology that waits. An edit is published together with its first state; until
/// then the earlier surface stays. A body that is not placed has no states.
/// @return false if edits could come that explain the topology.
bool SurfaceNode::bindWaiting(bool is_late) {
  const softbody_msgs::TetTopology& message = *waiting_topology_;
  const bool is_known = editor_.started() && sameTets(editor_.body().volume(), message);
  const bool is_first = !editor_.started() && message.revision == 0;
  if (!is_known && !is_first && (edits_subscriber_.getNumPublishers() > 0 || !is_late)) {
    ROS_WARN_THROTTLE(5.0, "waiting for the cuts that explain the volume's topology of revision %u",
                      message.revision);
    edits_timeout_.stop();
    edits_timeout_.start();
    return false;
  }
  const bool with_next_state =
      (!is_known || editor_.placed()) && binding_ && message.revision > binding_->volume->revision;
  if (!is_known) startBody(message);
  BoundSurface binding = bindTo(waiting_topology_, editor_.body().surface(), options_.body_frame);
  if (with_next_state)
    next_binding_ = std::move(binding);
  else
    setBinding(std::move(binding));
  return true;
}

void SurfaceNode::onVolumeEdits(const softbody_msgs::CutHistoryConstPtr& message) {
  try {
    const auto scope = timer_.stage(kStage, true);
    editor_.onVolumeEdits(fromMessage(*message));
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("the simulator's cuts up to revision "
                     << message->revision << " are not used: " << error.what() << "; rostopic info "
                     << edits_subscriber_.getTopic() << " names the sender");
    return;
  }
  useWaiting(false);
}

/// Starts with a body whose cuts are not known.
void SurfaceNode::startBody(const softbody_msgs::TetTopology& message) {
  if (message.revision > 0) {
    ROS_WARN("nobody has published the cuts of the volume's revision %u: the surface starts uncut",
             message.revision);
  }
  const auto scope = timer_.stage(kStage, true);
  editor_.start(fromMessage(message));
}

void SurfaceNode::setBinding(BoundSurface binding) {
  queries_.forget();
  binding_ = std::move(binding);
  next_binding_.reset();
  cut_display_.onTopologyChanged();
  publisher_.setTopology(binding_->topology);
  warnOfOutside(binding_->surface);
}

/// A state may belong to the image of the last one: it is then newer.
void SurfaceNode::onState(const softbody_msgs::MeshStateConstPtr& message) try {
  fromMessage(*message);  // throws if it is no state
  if (stamps_.admits(stampOfImage(*message))) useState(message);
} catch (const std::exception& error) {
  diagnostics_.countRefused();
  ROS_WARN_STREAM_THROTTLE(1.0, "volume state of " << message->header.stamp
                                                   << " is not used: " << error.what() << "; rostopic info "
                                                   << state_subscriber_.getTopic() << " names the sender");
}

void SurfaceNode::useState(const softbody_msgs::MeshStateConstPtr& message) {
  if (next_binding_ && next_binding_->volume->revision == message->revision)
    setBinding(*std::exchange(next_binding_, std::nullopt));
  if (!binding_ || binding_->volume->revision != message->revision) {
    waiting_state_ = message;
    ROS_WARN_THROTTLE(5.0, "waiting for the volume's topology of revision %u", message->revision);
    return;
  }
  waiting_state_.reset();
  try {
    publishState(*message);
  } catch (const std::exception& error) {
    diagnostics_.countRefused();
    ROS_WARN_STREAM_THROTTLE(1.0, "volume state of " << message->header.stamp
                                                     << " is not used: " << error.what() << "; rostopic info "
                                                     << state_subscriber_.getTopic() << " names the sender");
  }
}

void SurfaceNode::publishState(const softbody_msgs::MeshState& volume) {
  MeshState surface;
  const MeshState state = fromMessage(volume);
  {
    const auto scope = timer_.stage(kStage);
    surface = binding_->surface.apply(state);
  }
  publisher_.publishState(binding_->surface.topology(), surface, volume.header);
  cut_display_.publish(binding_->surface.topology(), surface, state, volume.header);
  publisher_.publishTiming(timer_.take(), volume.header);
  diagnostics_.onState(binding_->surface.topology(), surface, volume.header.stamp);
  queries_.show(&binding_->surface.topology(), std::move(surface), volume.header);
  editor_.onState(state, volume.header);
}

}  // namespace softbody
