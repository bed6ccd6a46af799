#pragma once

#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "softbody_common/ros/queued_calls.h"

namespace softbody {

/// Calls functions between two callbacks of a node, from any other thread, and waits for their results.
class NodeCalls {
 public:
  explicit NodeCalls(const ros::NodeHandle& node) : calls_(node.getCallbackQueue()) {}

  /// @param ends whether nobody waits any more. @return the function's result; nothing: it has ended. The
  /// function may still be called then. @throw what the function throws.
  template <typename Result>
  std::optional<Result> result(std::function<Result()> function, const std::function<bool()>& ends) {
    const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(function));
    std::future<Result> answer = task->get_future();
    calls_.add([task] { (*task)(); });
    while (answer.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready)
      if (ends()) return std::nullopt;
    return answer.get();
  }

 private:
  QueuedCalls calls_;
};

}  // namespace softbody
