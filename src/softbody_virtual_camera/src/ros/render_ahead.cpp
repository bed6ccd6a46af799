#include "ros/render_ahead.h"

#include <chrono>
#include <utility>

namespace softbody::virtual_camera {

RenderAhead::RenderAhead(Render render, Clock clock)
    : render_(std::move(render)), clock_(std::move(clock)), thread_([this] { run(); }) {}

RenderAhead::~RenderAhead() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RenderAhead::start(int frame, const ros::Time& due) {
  {
    const std::lock_guard lock(mutex_);
    due_ = {frame, due};
  }
  changed_.notify_all();
}

CaptureMessages RenderAhead::take() {
  std::unique_lock lock(mutex_);
  is_wanted_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return ready_.has_value(); });
  is_wanted_ = false;
  CaptureMessages messages = *std::exchange(ready_, std::nullopt);
  setStamp(clock_(), &messages);
  return messages;
}

void RenderAhead::waitToBegin(const ros::Time& due, std::unique_lock<std::mutex>* lock) {
  const ros::Duration lead = render_time_ + ros::Duration(kMargin_s);
  while (!is_wanted_ && !ends_) {
    const ros::Duration left = due - clock_() - lead;
    if (left <= ros::Duration(0.0)) return;
    changed_.wait_for(*lock, std::chrono::nanoseconds(left.toNSec()));
  }
}

void RenderAhead::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return due_ || ends_; });
    if (ends_) return;
    const Due due = *std::exchange(due_, std::nullopt);
    waitToBegin(due.time, &lock);
    if (ends_) return;
    lock.unlock();
    const ros::Time begin = clock_();
    CaptureMessages messages = render_(due.frame);
    render_time_ = clock_() - begin;
    lock.lock();
    ready_ = std::move(messages);
    changed_.notify_all();
  }
}

}  // namespace softbody::virtual_camera
