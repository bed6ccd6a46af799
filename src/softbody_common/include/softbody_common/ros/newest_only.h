#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "softbody_common/ros/queued_calls.h"

namespace softbody {

/// Passes on the newest of the values that came while the node was busy. So its latency is bounded. The older
/// ones are dropped, and counted.
template <typename Value>
class NewestOnly {
 public:
  /// @param pass_on is called in the queue, behind the messages that wait there already.
  NewestOnly(ros::CallbackQueueInterface* queue, std::function<void(const Value& value)> pass_on)
      : pass_on_(std::move(pass_on)), calls_(queue) {}

  void add(Value value) {
    if (waiting_)
      ++dropped_;
    else
      calls_.add([this] { pass_on_(*std::exchange(waiting_, std::nullopt)); });
    waiting_ = std::move(value);
  }

  /// Since the start.
  int dropped() const { return dropped_; }

 private:
  std::function<void(const Value& value)> pass_on_;
  std::optional<Value> waiting_;
  int dropped_ = 0;
  QueuedCalls calls_;
};

}  // namespace softbody
