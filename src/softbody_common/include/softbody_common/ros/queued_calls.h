#pragma once

#include <ros/callback_queue_interface.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <utility>

namespace softbody {

/// Runs functions in a node's callback queue, for libraries that call in another thread.
class QueuedCalls {
 public:
  explicit QueuedCalls(ros::CallbackQueueInterface* queue) : queue_(queue) {}
  /// Waits for the function that runs; the others are dropped.
  ~QueuedCalls() { queue_->removeByID(id()); }
  QueuedCalls(const QueuedCalls&) = delete;
  QueuedCalls& operator=(const QueuedCalls&) = delete;

  /// From any thread.
  void add(std::function<void()> function) {
    queue_->addCallback(boost::make_shared<Callback>(std::move(function)), id());
  }

 private:
  struct Callback : ros::CallbackInterface {
    explicit Callback(std::function<void()> f) : function(std::move(f)) {}
    CallResult call() override {
      function();
      return Success;
    }
    std::function<void()> function;
  };

  std::uint64_t id() const { return reinterpret_cast<std::uintptr_t>(this); }

  ros::CallbackQueueInterface* queue_;
};

}  // namespace softbody
