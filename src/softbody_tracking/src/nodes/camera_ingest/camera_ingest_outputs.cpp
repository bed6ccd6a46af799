#include "nodes/camera_ingest/camera_ingest_outputs.h"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/image_encodings.h>
#include <softbody_msgs/StageTiming.h>
#include <visualization_msgs/Marker.h>

#include <boost/make_shared.hpp>

#include "ros/image_pixels.h"
#include "ros/points_marker.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/camera/point_cloud.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr std::int64_t kMarkerPeriod_ns = 200'000'000;
constexpr int kMaxMarkerPoints = 20'000;

}  // namespace

sensor_msgs::ImagePtr blankDepth(const Pinhole& camera, const std_msgs::Header& header) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header = header;
  image->width = static_cast<std::uint32_t>(camera.width);
  image->height = static_cast<std::uint32_t>(camera.height);
  image->encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  image->is_bigendian = isBigEndian() ? 1 : 0;
  image->step = image->width * sizeof(float);
  image->data.resize(std::size_t{image->step} * image->height);
  return image;
}

cv::Mat1f depthIn(sensor_msgs::Image* image) {
  return cv::Mat1f(static_cast<int>(image->height), static_cast<int>(image->width),
                   reinterpret_cast<float*>(image->data.data()), image->step);
}

CameraIngestOutputs::CameraIngestOutputs(ros::NodeHandle handle, double voxel_size_m)
    : voxel_size_m_(voxel_size_m),
      color_(image_transport::ImageTransport(handle).advertise(topics::kRgbRect, kMostWaiting)),
      depth_(image_transport::ImageTransport(handle).advertise(topics::kDepthRect, kMostWaiting)),
      info_(handle.advertise<sensor_msgs::CameraInfo>(topics::kRgbInfo, kMostWaiting)),
      depth_info_(handle.advertise<sensor_msgs::CameraInfo>(topics::kDepthRectInfo, kMostWaiting)),
      points_(handle.advertise<sensor_msgs::PointCloud2>(topics::kPoints, kMostWaiting)),
      points_marker_(handle.advertise<visualization_msgs::Marker>(topics::kPointsMarker, 1)),
      timing_(handle.advertise<softbody_msgs::StageTiming>(topics::kTiming, kMostWaiting)) {}

bool CameraIngestOutputs::hasPointSubscriber() const {
  return points_.getNumSubscribers() > 0 || points_marker_.getNumSubscribers() > 0;
}

bool CameraIngestOutputs::hasSubscriber() const {
  if (color_.getNumSubscribers() > 0 || depth_.getNumSubscribers() > 0) return true;
  for (const ros::Publisher* publisher : {&info_, &depth_info_, &points_, &points_marker_, &timing_})
    if (publisher->getNumSubscribers() > 0) return true;
  return false;
}

void CameraIngestOutputs::publish(const IngestedFrame& ingested, const std_msgs::Header& header,
                                  StageTimer* timer) {
  const RgbdFrame& frame = ingested.frame;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(toMessage(frame.camera));
  info->header = header;
  info_.publish(info);
  depth_info_.publish(info);
  if (ingested.color_message)
    color_.publish(ingested.color_message);
  else if (color_.getNumSubscribers() > 0)
    color_.publish(toMessage(frame.color, header));
  depth_.publish(ingested.depth_message);
  const bool has_color = !frame.color.empty();  // not if points are wanted only since ingest()
  if (has_color && points_.getNumSubscribers() > 0) {
    const auto stage = timer->stage("point cloud");
    publishPoints(frame, header);
  }
  if (has_color && points_marker_.getNumSubscribers() > 0) publishPointsMarker(frame, header);
  const std::vector<StageTime> stages = timer->take();
  if (timing_.getNumSubscribers() > 0) {
    const auto timing =
        boost::make_shared<softbody_msgs::StageTiming>(timingMessage("camera_ingest", stages));
    timing->header = header;
    timing_.publish(timing);
  }
}

void CameraIngestOutputs::publishPoints(const RgbdFrame& frame, const std_msgs::Header& header) const {
  if (voxel_size_m_ == 0.0)
    points_.publish(toMessage(organizedCloud(frame), frame.camera.width, header));
  else
    points_.publish(toMessage(voxelCloud(frame, voxel_size_m_), 0, header));
}

void CameraIngestOutputs::publishPointsMarker(const RgbdFrame& frame, const std_msgs::Header& header) {
  const std::int64_t stamp = toNanoseconds(header.stamp);
  const bool jumped_back = last_marker_ && stamp < *last_marker_;
  if (last_marker_ && !jumped_back && stamp - *last_marker_ < kMarkerPeriod_ns) return;
  last_marker_ = stamp;
  const auto marker =
      boost::make_shared<visualization_msgs::Marker>(makePointsMarker(thinnedCloud(frame, kMaxMarkerPoints)));
  marker->header = header;
  points_marker_.publish(marker);
}

}  // namespace softbody
