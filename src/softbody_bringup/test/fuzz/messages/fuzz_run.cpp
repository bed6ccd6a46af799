#include "fuzz/messages/fuzz_run.h"

#include <execinfo.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "fuzz/messages/target.h"

namespace softbody::fuzz {
namespace {

constexpr std::size_t kMessagesPerCheck = 2000;
constexpr double kLongest_s = 20.0;  // one message; the machine may be busy
constexpr unsigned kHang_s = 60;
constexpr double kMostGrowth_mb = 300.0;  // allocators keep what they once had

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Says where the run was when the process dies, and ends it if the next step hangs. The text is made before.
class LastWords {
 public:
  LastWords() {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) std::signal(signal, &say);
  }
  static void set(const std::string& words) {
    alarm(kHang_s);
    const std::size_t size = words.copy(text, sizeof(text));
    length = size;
  }

 private:
  static void say(int signal) {
    if (write(STDERR_FILENO, text, length) < 0) _exit(1);
    std::array<void*, 64> frames{};  // of the thread that failed, also of one with an exception
    backtrace_symbols_fd(frames.data(), backtrace(frames.data(), static_cast<int>(frames.size())),
                         STDERR_FILENO);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  static inline char text[256];
  static inline std::atomic<std::size_t> length{0};
};

class FuzzRun {
 public:
  FuzzRun(const TargetKind& kind, std::uint64_t seed) : kind_(kind), seed_(seed), choice_(seed) {}
  ~FuzzRun() {
    alarm(0);
    end();
  }

  FuzzReport run(std::size_t messages) {
    make();
    const auto start = Clock::now();
    double settled_mb = 0.0;
    std::size_t next_check = 0, made_at = 0;
    const auto done = [&] { return report_.messages >= messages; };
    do {
      if (report_.messages - made_at >= kind_.lifetime) {
        made_at = report_.messages;
        make();
      }
      if (settled_mb == 0.0 && report_.messages >= messages / 10) settled_mb = residentMegabytes();
      next_check = report_.messages + std::min(kMessagesPerCheck, kind_.lifetime);
      while (report_.fault.empty() && report_.messages < next_check && !done()) step();
      check();
    } while (report_.fault.empty() && !done());
    report_.seconds = secondsSince(start);
    if (settled_mb > 0.0) report_.grown_mb = residentMegabytes() - settled_mb;
    if (report_.fault.empty() && report_.grown_mb > kMostGrowth_mb)
      report_.fault = fmt::format("the memory grew by {:.0f} MB", report_.grown_mb);
    return report_;
  }

 private:
  /// The inputs end before the node whose callbacks they use.
  void end() {
    if (target_) target_->inputs.clear();
    target_.reset();
  }

  void make() {
    end();
    target_ = kind_.make();
    weights_ = 0;
    for (const Target::Weighted& weighted : target_->inputs) weights_ += weighted.weight;
    check();
  }

  Input& chosen() {
    std::size_t place = choice_.below(weights_);
    for (const Target::Weighted& weighted : target_->inputs) {
      if (place < weighted.weight) return *weighted.input;
      place -= weighted.weight;
    }
    throw std::logic_error("no input");
  }

  void step() {
    LastWords::set(
        fmt::format("\n{}: seed {}, after {} mutated messages\n", kind_.name, seed_, report_.messages));
    if (choice_.oneIn(20'000)) ros_.advance(-30.0);  // a bag starts again
    ros_.advance(choice_.oneIn(3) ? 0.033 : 0.001);
    const auto start = Clock::now();
    try {
      report_.messages += static_cast<std::size_t>(chosen().give(!choice_.oneIn(8), &choice_));
    } catch (const std::exception& error) {
      report_.fault = fmt::format("after {} messages: {}", report_.messages, error.what());
    }
    const double seconds = secondsSince(start);
    report_.slowest_s = std::max(report_.slowest_s, seconds);
    if (seconds > kLongest_s)
      report_.fault = fmt::format("message {} took {:.0f} s", report_.messages, seconds);
  }

  void check() {
    if (!report_.fault.empty()) return;
    LastWords::set(fmt::format("\n{}: seed {}, good messages after {} mutated ones\n", kind_.name, seed_,
                               report_.messages));
    const std::string fault = target_->check();
    if (!fault.empty()) report_.fault = fmt::format("good messages after {}: {}", report_.messages, fault);
  }

  const TargetKind& kind_;
  std::uint64_t seed_;
  LoneRos& ros_ = LoneRos::instance();
  Choice choice_;
  std::unique_ptr<Target> target_;
  std::size_t weights_ = 0;
  FuzzReport report_;
  LastWords words_;
};

}  // namespace

FuzzReport fuzzNode(const std::string& node, std::uint64_t seed, std::size_t messages) {
  for (const TargetKind& kind : targetKinds()) {
    if (kind.name == node) return FuzzRun(kind, seed).run(messages);
  }
  throw std::out_of_range("no node " + node);
}

}  // namespace softbody::fuzz
