#include "nodes/surface/cut_publisher.h"

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {
namespace {

/// A simulator that publishes without the cut for this long will not make it.
constexpr double kLongestLag = 3.0;  // [s]

}  // namespace

CutPublisher::CutPublisher(ros::NodeHandle node, std::string body_frame)
    : body_frame_(std::move(body_frame)),
      cut_publisher_(node.advertise<softbody_msgs::Cut>(topics::kCut, 20)),
      edits_publisher_(node.advertise<softbody_msgs::CutHistory>(topics::kSurfaceCuts, 1, true)) {}

void CutPublisher::publish(const Cut& cut, const ros::Time& stamp) {
  const auto message = boost::make_shared<softbody_msgs::Cut>(toMessage(cut));
  message->header.stamp = stamp;
  message->header.frame_id = body_frame_;
  cut_publisher_.publish(message);
}

void CutPublisher::publishEdits(const CuttableSurface& body, const ros::Time& stamp, bool pending) {
  edits_ = historyMessage(body.edits(), body.uncutVolume(), body_frame_, stamp);
  edits_publisher_.publish(edits_);
  pending_ = pending ? std::optional(edits_->revision) : std::nullopt;
  lag_.reset();
}

void CutPublisher::confirm(std::uint32_t revision) {
  if (pending_ && *pending_ <= revision) pending_.reset();
}

void CutPublisher::resend(std::uint32_t simulator_revision) {
  if (!pending_ || *pending_ != simulator_revision + 1) return;
  ROS_WARN("the simulator has not made the cut of revision %u; it is sent again", *pending_);
  edits_publisher_.publish(boost::make_shared<softbody_msgs::CutHistory>(*edits_));
}

bool CutPublisher::isOverdue(std::uint32_t surface_revision, std::uint32_t simulator_revision) {
  if (surface_revision <= simulator_revision) {
    lag_.reset();
    return false;
  }
  const ros::WallTime now = ros::WallTime::now();
  if (!lag_ || lag_->simulator_revision != simulator_revision) lag_ = Lag{now, simulator_revision};
  return (now - lag_->since).toSec() > kLongestLag;
}

}  // namespace softbody
