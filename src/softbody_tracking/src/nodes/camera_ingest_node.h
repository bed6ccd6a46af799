#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include <memory>
#include <string>
#include <vector>

#include "nodes/image_pairer.h"
#include "nodes/wall_throttle.h"
#include "softbody_common/parameters.h"
#include "softbody_common/stage_timer.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/stream_monitor.h"

namespace softbody {

struct CameraIngestNodeConfig {
  SyncConfig sync;
  int queue_size = 10;
  double voxel_size_m = 0.0;       ///< of points; 0: organised, one point a pixel
  double silence_timeout_s = 2.0;  ///< without a frame for so long the node says why
};

/// Raw colour and registered depth in; rectified images and coloured points out.
class CameraIngestNode {
 public:
  /// @throw std::invalid_argument for a bad parameter.
  CameraIngestNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  void readConfig(Parameters& parameters);
  void advertise();
  void subscribe();
  void resetPairer();

  void onColor(const sensor_msgs::ImageConstPtr& image);
  void onDepth(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void onPair(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth);
  /// False for an image that comes after a later one, or after one of its stamp; one a second or more back
  /// starts the stream again.
  bool accept(Stream stream, const ros::Time& stamp, ros::Time* last);
  bool drop(Stream stream, const std::string& what, const std::string& why);

  bool anySubscriber() const;
  void publish(const RgbdFrame& frame, const std_msgs::Header& header);
  void completeFrame(const std_msgs::Header& color, const std_msgs::Header& depth);

  struct Remark {
    std::string about, sentence;
  };
  void watch();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);
  double secondsWithoutFrame() const;
  bool isStarting() const;
  std::string silence() const;
  std::string complaint() const;
  std::vector<Remark> remarks() const;

  ros::NodeHandle handle_, private_handle_;
  CameraIngestNodeConfig config_;
  std::unique_ptr<CameraIngest> ingest_;
  std::unique_ptr<ImagePairer> pairer_;
  std::unique_ptr<StreamMonitor> monitor_;
  sensor_msgs::CameraInfoConstPtr info_;
  StageTimer timer_;

  ros::Time last_color_, last_depth_, last_frame_;  ///< stamps, stamps, when it was completed
  ros::WallTime start_, both_came_;                 ///< the latter: when colour and depth had, usable or not
  int frames_ = 0, refused_ = 0;                    ///< since the last diagnosis
  double latency_s_ = 0.0;  ///< camera to here, of the last frame; below 0: its stamp is yet to come
  std::string color_frame_, depth_frame_;  ///< of the last frame
  ros::WallTime last_diagnosis_;
  WallThrottle throttle_;

  image_transport::ImageTransport transport_;
  image_transport::Subscriber color_subscriber_, depth_subscriber_;
  ros::Subscriber info_subscriber_;
  ros::Publisher color_, info_publisher_, depth_, points_, timing_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer watch_timer_;
};

}  // namespace softbody
