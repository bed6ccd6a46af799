#pragma once

#include <ros/time.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::virtual_camera {

/// Renders one frame in its own thread, while the caller waits for the time to send it. It begins late, so
/// that a frame is ready just before its time and takes no core from those who work on the frame before.
class RenderAhead {
 public:
  using Render = std::function<CaptureMessages(int frame)>;
  using Clock = std::function<ros::Time()>;

  /// A frame is ready so long before its time, if it takes as long to render as the last one [s].
  static constexpr double kMargin_s = 0.002;

  explicit RenderAhead(Render render, Clock clock = ros::Time::now);
  RenderAhead(const RenderAhead&) = delete;
  RenderAhead& operator=(const RenderAhead&) = delete;
  ~RenderAhead();

  /// Renders a frame until its time comes. The frame before must have been taken.
  void start(int frame, const ros::Time& due);
  /// @return the frame that was started, with the present as its stamp; waits until it is rendered. After
  /// that, nothing is rendered until the next start().
  CaptureMessages take();

 private:
  struct Due {
    int frame;
    ros::Time time;
  };

  void run();
  void waitToBegin(const ros::Time& due, std::unique_lock<std::mutex>* lock);

  Render render_;
  Clock clock_;
  ros::Duration render_time_;  ///< of the last frame
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Due> due_;
  std::optional<CaptureMessages> ready_;
  bool is_wanted_ = false, ends_ = false;
  std::thread thread_;  ///< last, because it uses the members above
};

}  // namespace softbody::virtual_camera
