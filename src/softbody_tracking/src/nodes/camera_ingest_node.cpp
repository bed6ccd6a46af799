#include "nodes/camera_ingest_node.h"

#include <fmt/format.h>
#include <sensor_msgs/PointCloud2.h>
#include <softbody_msgs/StageTiming.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/ros_parameters.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/camera/point_cloud.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kWatchPeriod_s = 0.5;
constexpr double kStartsAgain_s = 1.0;  // a smaller jump back is a late image

}  // namespace

CameraIngestNode::CameraIngestNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      start_(ros::WallTime::now()),
      last_diagnosis_(start_),
      transport_(handle_),
      diagnostics_(handle_, private_handle_, private_handle_.getNamespace()) {
  Parameters parameters = readParameters(private_handle_);
  readConfig(parameters);
  ingest_ = std::make_unique<CameraIngest>(readCameraIngestConfig(parameters));
  // Read by image_transport itself.
  parameters.text("image_transport", "raw");
  warnUnknown(parameters);
  monitor_ = std::make_unique<StreamMonitor>(
      config_.sync.exact ? 0 : toNanoseconds(ros::Time(config_.sync.tolerance_s)),
      toNanoseconds(ros::Time(config_.silence_timeout_s)));
  resetPairer();
  advertise();
  subscribe();
  diagnostics_.setHardwareID("RGB-D camera");
  diagnostics_.add("frames", this, &CameraIngestNode::diagnose);
  // Wall time: without /clock a simulated timer would never fire, and that is worth saying.
  watch_timer_ = handle_.createWallTimer(ros::WallDuration(kWatchPeriod_s), [this](const auto&) { watch(); });
}

void CameraIngestNode::readConfig(Parameters& parameters) {
  config_.sync = readSyncConfig(parameters);
  config_.queue_size = parameters.integer("queue_size", config_.queue_size, 1, 1000);
  config_.voxel_size_m = parameters.number("voxel_size_m", config_.voxel_size_m, 0.0, 1.0);
  config_.silence_timeout_s = parameters.number("silence_timeout_s", config_.silence_timeout_s, 0.1, 3600.0);
}

void CameraIngestNode::advertise() {
  color_ = handle_.advertise<sensor_msgs::Image>(topics::kRgbRect, 1);
  info_publisher_ = handle_.advertise<sensor_msgs::CameraInfo>(topics::kRgbInfo, 1);
  depth_ = handle_.advertise<sensor_msgs::Image>(topics::kDepthRect, 1);
  points_ = handle_.advertise<sensor_msgs::PointCloud2>(topics::kPoints, 1);
  timing_ = handle_.advertise<softbody_msgs::StageTiming>(topics::kTiming, 1);
}

void CameraIngestNode::subscribe() {
  const auto queue = static_cast<std::uint32_t>(config_.queue_size);
  const image_transport::TransportHints hints("raw", ros::TransportHints().tcpNoDelay(), private_handle_);
  info_subscriber_ = handle_.subscribe(topics::kCameraColorInfo, queue, &CameraIngestNode::onInfo, this);
  color_subscriber_ =
      transport_.subscribe(topics::kCameraColor, queue, &CameraIngestNode::onColor, this, hints);
  depth_subscriber_ =
      transport_.subscribe(topics::kCameraDepth, queue, &CameraIngestNode::onDepth, this, hints);
}

void CameraIngestNode::resetPairer() {
  const auto on_pair = [this](const auto& color, const auto& depth) { onPair(color, depth); };
  pairer_ = config_.sync.exact ? makeExactPairer(config_.queue_size, on_pair)
                               : makeApproximatePairer(config_.queue_size, config_.sync.tolerance_s, on_pair);
}

bool CameraIngestNode::accept(Stream stream, const ros::Time& stamp, ros::Time* last) {
  if (stamp.isZero()) {
    monitor_->unstamped(stream);
    return drop(stream, "an image without a stamp", "is dropped: nothing can be placed in time by it");
  }
  if (stamp < *last && *last - stamp < ros::Duration(kStartsAgain_s))
    return drop(stream, "a late image",
                fmt::format("is dropped: it comes {:.3f} s after a later one", (*last - stamp).toSec()));
  // Twice is no time in between, and tf refuses, loudly and in every node, what it has of that stamp.
  if (stamp == *last)
    return drop(stream, "a second image", fmt::format("with the stamp {:.6f} is dropped", stamp.toSec()));
  if (stamp < *last) {
    ROS_INFO_STREAM("time jumped back by " << (*last - stamp)
                                           << " s: the images that wait for a partner are dropped");
    resetPairer();
    monitor_->completed();
    last_color_ = last_depth_ = ros::Time();
  }
  *last = stamp;
  monitor_->arrived(stream, toNanoseconds(stamp), toNanoseconds(ros::Time::now()));
  return true;
}

/// @return false.
bool CameraIngestNode::drop(Stream stream, const std::string& what, const std::string& why) {
  const std::string topic = (stream == Stream::kColor ? color_subscriber_ : depth_subscriber_).getTopic();
  throttle_.warn(topic + what, fmt::format("{}: {} {}", topic, what, why));
  return false;
}

void CameraIngestNode::onColor(const sensor_msgs::ImageConstPtr& image) {
  if (accept(Stream::kColor, image->header.stamp, &last_color_)) pairer_->addColor(image);
}

void CameraIngestNode::onDepth(const sensor_msgs::ImageConstPtr& image) {
  if (accept(Stream::kDepth, image->header.stamp, &last_depth_)) pairer_->addDepth(image);
}

void CameraIngestNode::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  info_ = info;
  monitor_->arrived(Stream::kColorInfo, toNanoseconds(info->header.stamp), toNanoseconds(ros::Time::now()));
}

void CameraIngestNode::onPair(const sensor_msgs::ImageConstPtr& color,
                              const sensor_msgs::ImageConstPtr& depth) {
  if (!info_) return;
  if (!anySubscriber()) return completeFrame(color->header, depth->header);
  try {
    RgbdFrame frame;
    {
      const auto stage = timer_.stage("camera ingest");
      frame = frameFromMessages(*color, depth.get(), *info_, ingest_.get());
    }
    std_msgs::Header header = color->header;
    header.frame_id = withoutSlash(header.frame_id);
    publish(frame, header);
    completeFrame(color->header, depth->header);
  } catch (const std::exception& error) {
    timer_.take();
    ++refused_;
    monitor_->refused(error.what());
    throttle_.warn("refused", error.what());
  }
}

bool CameraIngestNode::anySubscriber() const {
  for (const ros::Publisher* publisher : {&color_, &info_publisher_, &depth_, &points_, &timing_}) {
    if (publisher->getNumSubscribers() > 0) return true;
  }
  return false;
}

void CameraIngestNode::publish(const RgbdFrame& frame, const std_msgs::Header& header) {
  if (info_publisher_.getNumSubscribers() > 0) {
    const auto info = boost::make_shared<sensor_msgs::CameraInfo>(toMessage(frame.camera));
    info->header = header;
    info_publisher_.publish(info);
  }
  if (color_.getNumSubscribers() > 0) color_.publish(toMessage(frame.color, header));
  if (depth_.getNumSubscribers() > 0) depth_.publish(toMessage(frame.depth, header));
  if (points_.getNumSubscribers() > 0) {
    const auto stage = timer_.stage("point cloud");
    const bool organized = config_.voxel_size_m == 0.0;
    points_.publish(organized ? toMessage(organizedCloud(frame), frame.camera.width, header)
                              : toMessage(voxelCloud(frame, config_.voxel_size_m), 0, header));
  }
  const std::vector<StageTime> stages = timer_.take();
  if (timing_.getNumSubscribers() > 0) {
    const auto timing =
        boost::make_shared<softbody_msgs::StageTiming>(timingMessage("camera_ingest", stages));
    timing->header = header;
    timing_.publish(timing);
  }
}

void CameraIngestNode::completeFrame(const std_msgs::Header& color, const std_msgs::Header& depth) {
  ++frames_;
  last_frame_ = ros::Time::now();
  latency_s_ = (last_frame_ - color.stamp).toSec();
  color_frame_ = withoutSlash(color.frame_id);
  depth_frame_ = withoutSlash(depth.frame_id);
  monitor_->completed();
}

}  // namespace softbody
