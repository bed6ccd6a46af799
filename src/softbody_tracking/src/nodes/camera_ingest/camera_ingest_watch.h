#pragma once

#include <ros/ros.h>
#include <std_msgs/Header.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "camera/stream_monitor.h"
#include "camera/sync_monitor.h"
#include "nodes/frame_watchdog.h"
#include "nodes/throttled_log.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {

/// Watches the streams of camera_ingest: explains in the log and in /diagnostics why no frame comes, what is
/// wrong with the frames that come, their rate and their latency, and how far colour and depth are apart.
class CameraIngestWatch {
 public:
  /// @param tolerance largest difference of the stamps of colour and depth; 0: none.
  /// @param silence_timeout_s time without a frame, after which it says so.
  /// @param topics of the streams at the moment.
  CameraIngestWatch(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                    Nanoseconds tolerance, double silence_timeout_s, std::function<StreamTopics()> topics);

  /// An image reached the pairer. Logs why it was dropped.
  void noteImage(Stream stream, const ros::Time& stamp, const StampVerdict& verdict);
  void noteInfo(const ros::Time& stamp);
  /// @param color of its colour image.
  void noteFrame(const std_msgs::Header& color);
  /// A frame's messages cannot be used.
  void noteRefusal(const std::string& why);

 private:
  struct Remark {
    std::string kind, sentence;
  };

  void check();
  void diagnose(NodeDiagnostics::Status& status);
  void diagnoseSync(NodeDiagnostics::Status& status) const;
  void logDropped(Stream stream, const RefusedStamp& refused);
  bool hasFrames() const { return watchdog_.silence().has_value(); }
  double secondsWithoutFrame() const;
  bool isStarting() const;
  std::string silence() const;
  std::string complaint() const;
  std::map<std::string, std::string> publishedTopics() const;
  std::vector<Remark> remarks() const;

  const double silence_timeout_s_;
  const Nanoseconds tolerance_;
  std::function<StreamTopics()> topics_;
  std::string own_namespace_;
  StreamMonitor monitor_;
  SyncMonitor sync_;
  std::array<RefusedStamps, 3> refused_stamps_;  ///< in the order of Stream
  ThrottledLog throttle_;
  FrameWatchdog watchdog_;
  ros::WallTime start_, both_came_;  ///< the latter: when colour and depth had come, usable or not
  int frames_ = 0, refused_ = 0;     ///< since the last diagnosis
  double latency_s_ = 0.0;   ///< from the last frame's stamp to its completion; below 0: clocks differ
  std::string color_frame_;  ///< frame_id in the last frame
  ros::WallTime last_diagnosis_;
  NodeDiagnostics diagnostics_;
  ros::WallTimer timer_;
};

}  // namespace softbody
