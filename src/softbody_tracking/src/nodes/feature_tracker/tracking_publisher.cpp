#include "nodes/feature_tracker/tracking_publisher.h"

#include <sensor_msgs/Image.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TrackingStatus.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/feature_messages.h"

namespace softbody {

TrackingPublisher::TrackingPublisher(ros::NodeHandle handle, std::string body_frame)
    : body_frame_(std::move(body_frame)) {
  features_ = handle.advertise<sensor_msgs::PointCloud2>(topics::kFeatures, 1);
  features_marker_ = handle.advertise<visualization_msgs::Marker>(topics::kFeaturesMarker, 1);
  labels_ = image_transport::ImageTransport(handle).advertise(topics::kLabels, 1);
  targets_ = handle.advertise<softbody_msgs::Targets>(topics::kTargets, 1);
  status_ = handle.advertise<softbody_msgs::TrackingStatus>(topics::kStatus, 1, true);
  timing_ = handle.advertise<softbody_msgs::StageTiming>(topics::kTiming, 1);
}

void TrackingPublisher::publishStatus(const std_msgs::Header& camera_header,
                                      const TrackingStatus& status) const {
  const auto message = boost::make_shared<softbody_msgs::TrackingStatus>(toMessage(status));
  message->header = camera_header;
  status_.publish(message);
}

void TrackingPublisher::publishFeatures(const std_msgs::Header& camera_header,
                                        const std::vector<TrackedFeature>& features) const {
  if (features_.getNumSubscribers() != 0) {
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(makeFeatureCloud(features));
    cloud->header = camera_header;
    features_.publish(cloud);
  }
  if (features_marker_.getNumSubscribers() != 0) {
    const auto marker = boost::make_shared<visualization_msgs::Marker>(makeFeatureMarker(features));
    marker->header = camera_header;
    features_marker_.publish(marker);
  }
}

void TrackingPublisher::publishLabels(const std_msgs::Header& camera_header, const TrackingResult& result,
                                      const cv::Size& size) const {
  if (labels_.getNumSubscribers() == 0) return;
  const auto image = boost::make_shared<sensor_msgs::Image>(makeLabelImage(result, size));
  image->header = camera_header;
  labels_.publish(image);
}

void TrackingPublisher::publishTargets(const std_msgs::Header& fixed_header, const TargetSet& targets) const {
  const auto message = boost::make_shared<softbody_msgs::Targets>(toMessage(targets));
  message->header = fixed_header;
  targets_.publish(message);
}

void TrackingPublisher::publishBodyPose(const std_msgs::Header& camera_header,
                                        const Eigen::Isometry3d& T_camera_body) {
  geometry_msgs::TransformStamped body = tf2::eigenToTransform(T_camera_body);
  body.header = camera_header;
  body.child_frame_id = body_frame_;
  tf_broadcaster_.sendTransform(body);
}

void TrackingPublisher::publishTiming(const std_msgs::Header& camera_header,
                                      const std::vector<StageTime>& stages) const {
  softbody_msgs::StageTiming message = timingMessage("feature_tracker", stages);
  message.header = camera_header;
  timing_.publish(message);
}

}  // namespace softbody
