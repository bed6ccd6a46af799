#include "nodes/feature_tracker/known_subscriber.h"

#include <tf2/exceptions.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kPatience_s = 5.0;  // the other graph may start later

/// The namespace of a surface's topics. @param name may also be one of its topics.
std::string surfaceOf(const std::string& name) {
  for (const std::string topic : {"/topology", "/state"})
    if (name.size() > topic.size() && name.compare(name.size() - topic.size(), topic.size(), topic) == 0)
      return name.substr(0, name.size() - topic.size());
  return name;
}

std::string whyAbsent(const ros::Subscriber& missing, bool has_topology) {
  const std::string topic = missing.getTopic();
  if (missing.getNumPublishers() == 0)
    return "nobody publishes " + topic + "; name the namespace of a surface's topics, e.g. /doll/surface";
  if (has_topology) return topic + " has no state yet: its body is not found, or its graph gets no images";
  return topic + " has a publisher, but no usable message has come; rostopic echo " + topic + " shows them";
}

}  // namespace

KnownSubscriber::KnownSubscriber(ros::NodeHandle handle, const std::string& surface, PoseLookup look_up)
    : surface_(handle.resolveName(surface)),
      look_up_(std::move(look_up)),
      stamps_(surface_.name() + "/state", StampGate::Repeats::kAccepted) {
  topology_subscriber_ = handle.subscribe(surface + "/topology", 1, &KnownSubscriber::onTopology, this);
  state_subscriber_ = handle.subscribe(surface + "/state", 1, &KnownSubscriber::onState, this,
                                       ros::TransportHints().tcpNoDelay());
}

void KnownSubscriber::onTopology(const softbody_msgs::MeshTopology::ConstPtr& message) try {
  if (topology_ && sameTopology(*topology_, *message)) return;
  surface_.setTopology(fromMessage(*message));
  topology_ = message;
} catch (const std::exception& error) {
  ROS_WARN_STREAM_THROTTLE(5.0, topology_subscriber_.getTopic()
                                    << " is not used: " << error.what() << "; rostopic info "
                                    << topology_subscriber_.getTopic() << " names the sender");
}

void KnownSubscriber::onState(const softbody_msgs::MeshState::ConstPtr& message) try {
  MeshState state = fromMessage(*message);
  const ros::Time stamp = stampOfImage(*message);
  state.observed = toNanoseconds(stamp);
  surface_.requireFits(state);  // before its stamp is judged: what is refused must not move time
  if (!stamps_.admits(stamp)) return;
  surface_.addState(state);
  header_ = message->header;
} catch (const std::exception& error) {
  ROS_WARN_STREAM_THROTTLE(5.0, state_subscriber_.getTopic()
                                    << " is not used: " << error.what() << "; rostopic info "
                                    << state_subscriber_.getTopic() << " names the sender");
}

std::optional<KnownSurface> KnownSubscriber::at(const RgbdFrame& frame) try {
  warnIfAbsent();
  if (!surface_.hasState()) return std::nullopt;
  std_msgs::Header header = header_;
  header.stamp = toTime(frame.stamp);
  return surface_.at(frame.stamp, frame.T_fixed_camera.inverse() * look_up_(header));
} catch (const tf2::TransformException& error) {
  ROS_WARN_STREAM_THROTTLE(5.0, "tf does not say where " << surface_.name() << " is: " << error.what());
  return std::nullopt;
}

/// A wrong name looks like a body that is not tracked yet.
void KnownSubscriber::warnIfAbsent() const {
  if (surface_.hasState() && surface_.hasTopology()) return;
  if ((ros::SteadyTime::now() - start_).toSec() < kPatience_s) return;
  const ros::Subscriber& missing = surface_.hasTopology() ? state_subscriber_ : topology_subscriber_;
  ROS_WARN_STREAM_THROTTLE(30.0, "known_surfaces: " << whyAbsent(missing, surface_.hasTopology()));
}

std::vector<std::unique_ptr<KnownSubscriber>> subscribeToKnown(const ros::NodeHandle& handle,
                                                               const std::vector<std::string>& surfaces,
                                                               const KnownSubscriber::PoseLookup& look_up) {
  std::vector<std::unique_ptr<KnownSubscriber>> subscribers;
  for (const std::string& name : surfaces) {
    const std::string surface = surfaceOf(name);
    std::string why;
    if (!ros::names::validate(surface, why))
      throw std::invalid_argument("parameter known_surfaces: '" + name + "' is no topic: " + why);
    if (handle.resolveName(surface + "/state") == handle.resolveName(topics::kSurfaceState))
      throw std::invalid_argument("parameter known_surfaces: '" + name +
                                  "' is the surface of the tracked body itself; name those of others");
    subscribers.push_back(std::make_unique<KnownSubscriber>(handle, surface, look_up));
  }
  return subscribers;
}

}  // namespace softbody
