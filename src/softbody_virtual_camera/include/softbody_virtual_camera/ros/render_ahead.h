#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::virtual_camera {

/// Renders one frame in its own thread, while the caller waits for the time to send it.
class RenderAhead {
 public:
  using Render = std::function<CaptureMessages(int frame)>;

  explicit RenderAhead(Render render);
  RenderAhead(const RenderAhead&) = delete;
  RenderAhead& operator=(const RenderAhead&) = delete;
  ~RenderAhead();

  /// Starts to render a frame. The frame before must have been taken.
  void start(int frame);
  /// @return the frame that was started; waits until it is rendered. After that, nothing is rendered until
  /// the next start().
  CaptureMessages take();

 private:
  void run();

  Render render_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<int> due_;
  std::optional<CaptureMessages> ready_;
  bool ends_ = false;
  std::thread thread_;  ///< last, because it uses the members above
};

}  // namespace softbody::virtual_camera
