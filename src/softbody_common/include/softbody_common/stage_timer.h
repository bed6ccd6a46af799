#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace softbody {

/// One row of a timing table.
struct StageTime {
  std::string stage;
  double milliseconds = 0.0;
  bool initialization = false;  ///< spent once, at start or after a reset
};

/// Collects the wall-clock times of a frame's stages: one `stage(name)` scope each.
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

  /// Times from now to the end of the returned object's life.
  Scope stage(std::string name, bool initialization = false) {
    return {this, std::move(name), initialization};
  }

  /// The rows so far, in order of completion; the timer is empty afterwards.
  std::vector<StageTime> take() { return std::move(times_); }

 private:
  std::vector<StageTime> times_;
};

}  // namespace softbody
