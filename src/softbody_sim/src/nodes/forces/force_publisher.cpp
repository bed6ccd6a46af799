#include "nodes/forces/force_publisher.h"

#include <softbody_msgs/Forces.h>
#include <visualization_msgs/MarkerArray.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/time.h"
#include "softbody_sim/ros/force_messages.h"

namespace softbody {
namespace {

constexpr double kRest = 2.0;  // the node has this many times what an estimate takes for its steps

}  // namespace

ForcePublisher::ForcePublisher(ros::NodeHandle node, const std::string& wrench_frame)
    : wrench_frame_(frameName(wrench_frame, "parameter wrench_frame")),
      forces_(node.advertise<softbody_msgs::Forces>(topics::kForces, 1)),
      markers_(node.advertise<visualization_msgs::MarkerArray>(topics::kForcesMarker, 1)) {}

bool ForcePublisher::isListenedTo() const {
  return forces_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0;
}

void ForcePublisher::publish(const TargetSet& targets, const std_msgs::Header& header,
                             const SurroundingsTracker& surroundings, Simulator* simulator,
                             Reactions* reactions) {
  if (targets.targets.empty()) return forget(header);
  if (!isListenedTo() && !surroundings.hasListenedPins()) return;
  const Surroundings& around = surroundings.lastSurroundings().all;
  reactions->pins.clear();
  const ros::SteadyTime start = ros::SteadyTime::now();
  if (start < rests_until_ || !schedule_.isDue(around.pins, toNanoseconds(header.stamp))) return;
  ForceEstimate estimate = simulator->externalForces(targets, around);
  const ros::SteadyTime end = ros::SteadyTime::now();
  rests_until_ = end + (end - start) * kRest;
  reactions->pins = estimate.pins;
  if (isListenedTo()) send(std::move(estimate), header, surroundings);
}

/// Without targets nothing is measured, and no spring disturbs the pins.
void ForcePublisher::forget(const std_msgs::Header& header) {
  schedule_ = {};
  if (!std::exchange(shows_arrows_, false)) return;
  softbody_msgs::Forces none;
  none.header = header;
  markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(makeForceMarkers(none)));
}

void ForcePublisher::send(ForceEstimate estimate, const std_msgs::Header& header,
                          const SurroundingsTracker& surroundings) {
  std::string frame = header.frame_id;
  if (!wrench_frame_.empty()) {
    const auto pose = surroundings.poseOf(wrench_frame_, header.stamp);
    if (pose) {
      frame = wrench_frame_;
      estimate = withWrenchIn(std::move(estimate), *pose);
    } else {
      ROS_WARN_STREAM_THROTTLE(5.0, "the net wrench is in '" << frame << "', because tf does not know '"
                                                             << wrench_frame_ << "'; check wrench_frame");
    }
  }
  const auto message = boost::make_shared<softbody_msgs::Forces>(toMessage(estimate, frame));
  message->header = header;
  shows_arrows_ = markers_.getNumSubscribers() > 0;
  if (shows_arrows_)
    markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(makeForceMarkers(*message)));
  forces_.publish(message);
}

}  // namespace softbody
