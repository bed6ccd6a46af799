#pragma once

#include <functional>
#include <future>
#include <optional>
#include <string>

namespace softbody {

/// Calls one service at a time in a thread, so that the window does not wait.
class ServiceCaller {
 public:
  /// Does nothing if a call is under way. @param call gives the answer in words.
  void start(std::function<std::string()> call) {
    if (!isBusy()) answer_ = std::async(std::launch::async, std::move(call));
  }

  bool isBusy() const { return answer_.valid(); }

  /// The answer of a call that has ended since the last time.
  std::optional<std::string> take() {
    if (!isBusy() || answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    return answer_.get();
  }

 private:
  std::future<std::string> answer_;  // its destructor waits
};

}  // namespace softbody
