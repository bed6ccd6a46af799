#include "nodes/surface/surface_node.h"

#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/object/visual_mesh.h"

namespace softbody {
namespace {

/// A topology whose cut has not come after this time was cut by somebody who does not publish cuts.
constexpr double kLongestWaitForCut = 0.5;  // [s]

constexpr char kStage[] = "Resolution Enhancement";

}  // namespace

SurfaceNode::SurfaceNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : SurfaceNode(node, private_node, readOptions(private_node)) {}

SurfaceNode::Options SurfaceNode::readOptions(const ros::NodeHandle& private_node) {
  Parameters parameters = readParameters(private_node);
  const std::string object = parameters.requiredText("object");
  const FileScope scope =
      parameters.flag("allow_outside", false) ? FileScope::kAnywhere : FileScope::kOwnFolder;
  Options options;
  options.body_frame = parameters.text("body_frame", "softbody");
  options.cutting = readCuttingConfig(parameters);
  warnUnknown(parameters);
  const ObjectDescription description = loadObjectDescription(object, scope);
  Warnings warnings = description.warnings;
  options.visual = loadVisualMesh(description, &warnings);
  for (const std::string& warning : warnings) ROS_WARN_STREAM(object << ": " << warning);
  return options;
}

SurfaceNode::SurfaceNode(ros::NodeHandle node, const ros::NodeHandle& private_node, Options options)
    : body_frame_(options.body_frame),
      visual_(std::move(options.visual)),
      stamps_(node.resolveName(topics::kVolumeState)),
      publisher_(node),
      cut_display_(node),
      editor_(node, body_frame_, options.cutting, [this] { useWaitingTopology(); }),
      services_(private_node, body_frame_, &editor_, [this](const CutPreview& preview) {
        cut_display_.startPreview(preview, editor_.body().volume());
      }) {
  cut_timeout_ = node.createWallTimer(
      ros::WallDuration(kLongestWaitForCut),
      [this](const ros::WallTimerEvent&) {
        if (const auto waiting = waiting_topology_) onTopology(waiting);
      },
      true, false);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  topology_subscriber_ = node.subscribe(topics::kVolumeTopology, 1, &SurfaceNode::onTopology, this, hints);
  state_subscriber_ = node.subscribe(topics::kVolumeState, 1, &SurfaceNode::onState, this, hints);
}

void SurfaceNode::onTopology(const softbody_msgs::TetTopologyConstPtr& message) {
  editor_.onVolumeTopology(message->revision);
  if (updateStamp(*message)) return;
  const softbody_msgs::TetTopologyConstPtr waiting = std::exchange(waiting_topology_, nullptr);
  try {
    if (!useTopology(message, waiting && sameMesh(*waiting, *message))) return;
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM_THROTTLE(
        1.0, "the volume's topology of revision " << message->revision << " is not used: " << error.what());
    return;
  }
  if (waiting_state_ && waiting_state_->revision == message->revision) useState(waiting_state_);
}

/// Topologies are sent again every second. @return whether this one is known; then only its stamp is new.
bool SurfaceNode::updateStamp(const softbody_msgs::TetTopology& message) {
  for (std::optional<BoundSurface>* known : {&binding_, &next_binding_}) {
    if (!*known || !sameMesh(*(*known)->volume, message)) continue;
    (*known)->topology->header.stamp = message.header.stamp;
    return true;
  }
  return false;
}

/// @param cut_is_late the topology has waited for its cut already. @return false if it has to wait now.
bool SurfaceNode::useTopology(const softbody_msgs::TetTopologyConstPtr& message, bool cut_is_late) {
  const bool is_edit = binding_ && message->revision != binding_->volume->revision;
  if (is_edit && sameTets(editor_.body().volume(), *message)) {
    useEdit(message);
    return true;
  }
  if (binding_ && message->revision == editor_.body().volume().revision + 1 && !cut_is_late) {
    waitForCut(message);
    return false;
  }
  startBody(message);
  return true;
}

/// An edit is published together with its first state; until then the earlier surface stays. A body that is
/// not placed has no states, and gets none before the tracker knows the edit.
void SurfaceNode::useEdit(const softbody_msgs::TetTopologyConstPtr& message) {
  BoundSurface binding = bindTo(message, editor_.body().surface(), body_frame_);
  if (editor_.placed())
    next_binding_ = std::move(binding);
  else
    setBinding(std::move(binding));
}

/// Another node publishes the cut of this topology.
void SurfaceNode::waitForCut(const softbody_msgs::TetTopologyConstPtr& message) {
  fromMessage(*message);  // throws if it is no topology
  waiting_topology_ = message;
  cut_timeout_.stop();
  cut_timeout_.start();
}

void SurfaceNode::useWaitingTopology() {
  if (waiting_topology_ && sameTets(editor_.body().volume(), *waiting_topology_))
    onTopology(std::exchange(waiting_topology_, nullptr));
}

/// Starts with an unknown body; its visual mesh is assumed to be uncut.
void SurfaceNode::startBody(const softbody_msgs::TetTopologyConstPtr& message) {
  {
    const auto scope = timer_.stage(kStage, true);
    MeshTopology visual = visual_;
    visual.revision = message->revision;
    editor_.start(visual, fromMessage(*message));
  }
  const VisualSurface& surface = editor_.body().surface();
  if (surface.outsideCount() > 0) {
    ROS_WARN("%d of %d visual vertices lie outside of the volume; they follow the nearest tet",
             surface.outsideCount(), static_cast<int>(visual_.rest_vertices.rows()));
  }
  BoundSurface binding = bindTo(message, surface, body_frame_);
  // A later revision is an edit whose cut is not known: it is published with its first state, too.
  if (binding_ && message->revision > binding_->volume->revision)
    next_binding_ = std::move(binding);
  else
    setBinding(std::move(binding));
}

void SurfaceNode::setBinding(BoundSurface binding) {
  binding_ = std::move(binding);
  next_binding_.reset();
  cut_display_.onTopologyChanged();
  publisher_.setTopology(binding_->topology);
}

/// A state may belong to the stamp of the last one: it is then newer.
void SurfaceNode::onState(const softbody_msgs::MeshStateConstPtr& message) {
  const StampVerdict verdict = stamps_.judge(message->header.stamp);
  if (verdict.accepted() || verdict.kind == StampVerdict::kRepeated) useState(message);
}

void SurfaceNode::useState(const softbody_msgs::MeshStateConstPtr& message) {
  if (next_binding_ && next_binding_->volume->revision == message->revision)
    setBinding(std::move(*next_binding_));
  if (!binding_ || binding_->volume->revision != message->revision) {
    waiting_state_ = message;
    ROS_WARN_THROTTLE(5.0, "waiting for the volume's topology of revision %u", message->revision);
    return;
  }
  waiting_state_.reset();
  try {
    publishState(*message);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(1.0,
                             "volume state of " << message->header.stamp << " is not used: " << error.what());
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
  editor_.onState(state, volume.header);
}

}  // namespace softbody
