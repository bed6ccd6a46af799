#include "softbody_virtual_camera/ros/render_ahead.h"

#include <utility>

namespace softbody::virtual_camera {

RenderAhead::RenderAhead(Render render) : render_(std::move(render)), thread_([this] { run(); }) {}

RenderAhead::~RenderAhead() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RenderAhead::start(int frame) {
  {
    const std::lock_guard lock(mutex_);
    due_ = frame;
  }
  changed_.notify_all();
}

CaptureMessages RenderAhead::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ready_.has_value(); });
  return *std::exchange(ready_, std::nullopt);
}

void RenderAhead::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return due_ || ends_; });
    if (ends_) return;
    const int frame = *std::exchange(due_, std::nullopt);
    lock.unlock();
    CaptureMessages messages = render_(frame);
    lock.lock();
    ready_ = std::move(messages);
    changed_.notify_all();
  }
}

}  // namespace softbody::virtual_camera
