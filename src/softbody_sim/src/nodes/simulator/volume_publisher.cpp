#include "nodes/simulator/volume_publisher.h"

#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/StageTiming.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {

VolumePublisher::VolumePublisher(ros::NodeHandle node, std::string body_frame)
    : body_frame_(std::move(body_frame)),
      edits_publisher_(node.advertise<softbody_msgs::CutHistory>(topics::kVolumeCuts, 1, true)),
      topology_publisher_(node.advertise<softbody_msgs::TetTopology>(topics::kVolumeTopology, 1, true)),
      state_publisher_(node.advertise<softbody_msgs::MeshState>(topics::kVolumeState, 1)),
      timing_publisher_(node.advertise<softbody_msgs::StageTiming>(topics::kTiming, 10)) {
  topology_timer_ = node.createTimer(ros::Duration(1.0), [this](const ros::TimerEvent&) {
    if (edits_) edits_publisher_.publish(edits_);
    if (topology_) topology_publisher_.publish(topology_);
  });
}

void VolumePublisher::publishEdited(const CuttableBody& body, const ros::Time& stamp) {
  edits_ = historyMessage(body.edits(), body.uncutVolume(), body_frame_, stamp);
  edits_publisher_.publish(edits_);
  publishTopology(body.volume(), stamp);
}

void VolumePublisher::publishTopology(const TetTopology& topology, const ros::Time& stamp) {
  // A new message: nodelets may still read the one that was sent.
  topology_ = boost::make_shared<softbody_msgs::TetTopology>(toMessage(topology));
  topology_->header.frame_id = body_frame_;
  topology_->header.stamp = stamp;
  topology_publisher_.publish(topology_);
}

void VolumePublisher::publishState(const MeshState& state, const std_msgs::Header& header) {
  const auto message = boost::make_shared<softbody_msgs::MeshState>(toMessage(state));
  message->header = header;
  state_publisher_.publish(message);
}

void VolumePublisher::publishTiming(const std::vector<StageTime>& stages, const std_msgs::Header& header) {
  const auto timing = boost::make_shared<softbody_msgs::StageTiming>(timingMessage("simulator", stages));
  timing->header = header;
  timing_publisher_.publish(timing);
}

}  // namespace softbody
