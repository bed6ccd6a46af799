#include "nodes/surface/surface_publisher.h"

#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/StageTiming.h>
#include <visualization_msgs/Marker.h>

#include <boost/make_shared.hpp>

#include "ros/planner_messages.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {

SurfacePublisher::SurfacePublisher(ros::NodeHandle node)
    : topology_publisher_(node.advertise<softbody_msgs::MeshTopology>(topics::kSurfaceTopology, 1, true)),
      state_publisher_(node.advertise<softbody_msgs::MeshState>(topics::kSurfaceState, 1)),
      marker_publisher_(node.advertise<visualization_msgs::Marker>(topics::kSurfaceMarker, 1)),
      mesh_publisher_(node.advertise<shape_msgs::Mesh>(topics::kSurfaceMesh, 1)),
      points_publisher_(node.advertise<sensor_msgs::PointCloud2>(topics::kSurfacePoints, 1)),
      timing_publisher_(node.advertise<softbody_msgs::StageTiming>(topics::kTiming, 10)),
      topology_timer_(
          node.createTimer(ros::Duration(1.0), [this](const ros::TimerEvent&) { publishTopology(); })) {}

void SurfacePublisher::setTopology(const softbody_msgs::MeshTopologyConstPtr& topology) {
  topology_ = topology;
  publishTopology();
}

void SurfacePublisher::publishTopology() {
  if (topology_) topology_publisher_.publish(topology_);
}

void SurfacePublisher::publishState(const MeshTopology& topology, const MeshState& state,
                                    const std_msgs::Header& header) {
  const auto message = boost::make_shared<softbody_msgs::MeshState>(toMessage(state));
  message->header = header;
  state_publisher_.publish(message);
  publishForPlanners(topology, state, header);
  if (marker_publisher_.getNumSubscribers() == 0) return;
  const auto marker = boost::make_shared<visualization_msgs::Marker>(makeSurfaceMarker(topology, state));
  marker->header = header;
  marker_publisher_.publish(marker);
}

void SurfacePublisher::publishForPlanners(const MeshTopology& topology, const MeshState& state,
                                          const std_msgs::Header& header) {
  if (mesh_publisher_.getNumSubscribers() > 0)
    mesh_publisher_.publish(boost::make_shared<shape_msgs::Mesh>(makeSurfaceMesh(topology, state)));
  if (points_publisher_.getNumSubscribers() == 0) return;
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(makeSurfaceCloud(topology, state));
  cloud->header = header;
  points_publisher_.publish(cloud);
}

void SurfacePublisher::publishTiming(std::vector<StageTime> stages, const std_msgs::Header& header) {
  // Only valid if the clock runs with the stamps; with a bag on the wall clock it does not.
  const double latency = secondsBetween(header.stamp, ros::Time::now());
  if (latency >= 0.0 && latency < 10.0) stages.push_back({"camera-to-mesh latency", 1e3 * latency, false});
  const auto timing = boost::make_shared<softbody_msgs::StageTiming>(timingMessage("surface", stages));
  timing->header = header;
  timing_publisher_.publish(timing);
}

}  // namespace softbody
