#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace softbody {

/// One row of a timing table.
struct StageTime {
  std::string stage;
  double milliseconds = 0.0;
  bool initialization = false;  ///< happens once, at the start or after a reset
};

/// Measures the wall-clock times of a frame's stages. Each stage is a scope, `stage(name)`.
class StageTimer {
 public:
  class Scope {
   public:
    Scope(StageTimer* timer, std::string stage, bool initialization)
        : timer_(timer), stage_(std::move(stage)), initialization_(initialization), start_(Clock::now()) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() {
      const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start_;
      timer_->times_.push_back({stage_, elapsed.count(), initialization_});
    }

   private:
    using Clock = std::chrono::steady_clock;
    StageTimer* timer_;
    std::string stage_;
    bool initialization_;
    Clock::time_point start_;
  };

  /// Measures from now until the returned object is destroyed.
  Scope stage(std::string name, bool initialization = false) {
    return {this, std::move(name), initialization};
  }

  /// The rows since the last call, in the order of their ends.
  std::vector<StageTime> take() { return std::move(times_); }

 private:
  std::vector<StageTime> times_;
};

}  // namespace softbody
