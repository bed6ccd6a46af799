#include "nodes/surface_node.h"

#include <softbody_msgs/StageTiming.h>
#include <visualization_msgs/Marker.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "cutting/patch/cut_patch.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

/// A topology without its cut for this long is taken for that of a cut nobody tells of.
constexpr double kLongestWaitForACut = 0.5;  // [s]

/// Whether weights for one serve the other; headers differ each time that a topology is sent.
bool sameMesh(const softbody_msgs::TetTopology& a, const softbody_msgs::TetTopology& b) {
  return a.revision == b.revision && a.rest_vertices == b.rest_vertices && a.tets == b.tets &&
         a.surface_triangles == b.surface_triangles;
}

bool sameTets(const TetTopology& volume, const softbody_msgs::TetTopology& message) {
  if (volume.revision != message.revision ||
      static_cast<std::size_t>(volume.tets.rows()) != message.tets.size())
    return false;
  const TetTopology other = fromMessage(message);
  return volume.rest_vertices.rows() == other.rest_vertices.rows() &&
         inSinglePrecision(volume.rest_vertices) == other.rest_vertices && volume.tets == other.tets;
}

}  // namespace

SurfaceNode::SurfaceNode(ros::NodeHandle node, const ros::NodeHandle& private_node) : cut_display_(node) {
  Parameters parameters = readParameters(private_node);
  const std::string object = parameters.requiredText("object");
  body_frame_ = parameters.text("body_frame", "softbody");
  const CuttingConfig cutting = readCuttingConfig(parameters);
  warnUnknown(parameters);
  const ObjectDescription description = loadObjectDescription(object);
  Warnings warnings = description.warnings;
  visual_ = loadVisualMesh(description, &warnings);
  for (const std::string& warning : warnings) ROS_WARN_STREAM(object << ": " << warning);

  topology_publisher_ = node.advertise<softbody_msgs::MeshTopology>(topics::kSurfaceTopology, 1, true);
  state_publisher_ = node.advertise<softbody_msgs::MeshState>(topics::kSurfaceState, 1);
  marker_publisher_ = node.advertise<visualization_msgs::Marker>(topics::kSurfaceMarker, 1);
  timing_publisher_ = node.advertise<softbody_msgs::StageTiming>(topics::kTiming, 10);
  topology_timer_ =
      node.createTimer(ros::Duration(1.0), [this](const ros::TimerEvent&) { publishTopology(); });
  late_timer_ = node.createWallTimer(
      ros::WallDuration(kLongestWaitForACut),
      [this](const ros::WallTimerEvent&) {
        if (const auto waiting = waiting_topology_) onTopology(waiting);
      },
      true, false);
  editor_.emplace(
      node, private_node, body_frame_, cutting, [this] { adoptWaitingTopology(); },
      [this](const CutPreview& preview) { cut_display_.preview(preview, editor_->body().volume()); });
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  topology_subscriber_ = node.subscribe(topics::kVolumeTopology, 1, &SurfaceNode::onTopology, this, hints);
  state_subscriber_ = node.subscribe(topics::kVolumeState, 1, &SurfaceNode::onState, this, hints);
}

void SurfaceNode::onTopology(const softbody_msgs::TetTopologyConstPtr& message) {
  editor_->resendTo(message->revision);
  // Sent again every second; only another body, or another revision, is news.
  for (std::optional<Binding>* known : {&binding_, &next_binding_}) {
    if (!*known || !sameMesh(*(*known)->volume, *message)) continue;
    (*known)->topology->header.stamp = message->header.stamp;
    return;
  }
  const softbody_msgs::TetTopologyConstPtr waiting = std::exchange(waiting_topology_, nullptr);
  try {
    if (binding_ && message->revision != binding_->volume->revision &&
        sameTets(editor_->body().volume(), *message)) {
      // An edit is published with its first state; until then the surface before it holds. A body without a
      // place has no states, and will have none before the tracker knows the edit.
      if (editor_->placed())
        next_binding_ = bindingTo(message);
      else
        replaceBinding(bindingTo(message));
    } else if (binding_ && message->revision == editor_->body().volume().revision + 1 &&
               !(waiting && sameMesh(*waiting, *message))) {
      fromMessage(*message);        // throws where it is no topology
      waiting_topology_ = message;  // of a cut that others send and that is yet to come
      late_timer_.stop();
      late_timer_.start();
      return;
    } else {
      startBody(message);
    }
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM_THROTTLE(
        1.0, "the volume's topology of revision " << message->revision << " is not used: " << error.what());
    return;
  }
  if (waiting_state_ && waiting_state_->revision == message->revision) onState(waiting_state_);
}

void SurfaceNode::adoptWaitingTopology() {
  if (waiting_topology_ && sameTets(editor_->body().volume(), *waiting_topology_))
    onTopology(std::exchange(waiting_topology_, nullptr));
}

void SurfaceNode::startBody(const softbody_msgs::TetTopologyConstPtr& message) {
  {
    const auto scope = timer_.stage("Resolution Enhancement", true);
    MeshTopology visual = visual_;
    visual.revision = message->revision;
    editor_->start(visual, fromMessage(*message));
  }
  const VisualSurface& surface = editor_->body().surface();
  if (surface.outsideCount() > 0) {
    ROS_WARN("%d of %d visual vertices lie outside the volume; they follow the nearest tet",
             surface.outsideCount(), static_cast<int>(visual_.rest_vertices.rows()));
  }
  // As an edit of one's own, whose cut is not known.
  if (binding_ && message->revision > binding_->volume->revision)
    next_binding_ = bindingTo(message);
  else
    replaceBinding(bindingTo(message));
}

SurfaceNode::Binding SurfaceNode::bindingTo(const softbody_msgs::TetTopologyConstPtr& message) const {
  const VisualSurface& surface = editor_->body().surface();
  const auto topology = boost::make_shared<softbody_msgs::MeshTopology>(toMessage(surface.topology()));
  topology->header.frame_id = body_frame_;
  topology->header.stamp = message->header.stamp;
  return {message, surface, topology};
}

void SurfaceNode::replaceBinding(Binding binding) {
  binding_ = std::move(binding);
  next_binding_.reset();
  cut_display_.forgetLines();
  publishTopology();
}

void SurfaceNode::onState(const softbody_msgs::MeshStateConstPtr& message) {
  if (next_binding_ && next_binding_->volume->revision == message->revision)
    replaceBinding(std::move(*next_binding_));
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
    const auto scope = timer_.stage("Resolution Enhancement");
    surface = binding_->surface.apply(state);
  }
  const auto message = boost::make_shared<softbody_msgs::MeshState>(toMessage(surface));
  message->header = volume.header;
  state_publisher_.publish(message);
  if (marker_publisher_.getNumSubscribers() > 0) {
    const auto marker = boost::make_shared<visualization_msgs::Marker>(
        makeSurfaceMarker(binding_->surface.topology(), surface));
    marker->header = volume.header;
    marker_publisher_.publish(marker);
  }
  cut_display_.show(binding_->surface.topology(), surface, state, volume.header);
  publishTiming(volume.header);
  editor_->onState(state, volume.header);
}

void SurfaceNode::publishTiming(const std_msgs::Header& header) {
  std::vector<StageTime> stages = timer_.take();
  // Only a clock that runs with the stamps tells the latency; a bag beside the wall clock does not.
  const double latency = (ros::Time::now() - header.stamp).toSec();
  if (latency >= 0.0 && latency < 10.0) stages.push_back({"camera-to-mesh latency", 1e3 * latency, false});
  const auto timing = boost::make_shared<softbody_msgs::StageTiming>(timingMessage("surface", stages));
  timing->header = header;
  timing_publisher_.publish(timing);
}

void SurfaceNode::publishTopology() {
  if (binding_)
    topology_publisher_.publish(boost::make_shared<softbody_msgs::MeshTopology>(*binding_->topology));
}

}  // namespace softbody
