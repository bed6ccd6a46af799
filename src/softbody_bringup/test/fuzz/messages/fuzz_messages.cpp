#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/fuzz_run.h"
#include "fuzz/messages/target.h"

/// Usage: fuzz_messages NODE [SECONDS [MESSAGES [SEED]]]. Without arguments it prints the nodes.
/// Exit code: 0 no fault, 1 a fault, 2 wrong usage.
int main(int argc, char** argv) try {
  using namespace softbody::fuzz;
  if (argc < 2) {
    for (const TargetKind& kind : targetKinds()) fmt::print("{}\n", kind.name);
    return 0;
  }
  FuzzLimits limits;
  limits.seconds = argc > 2 ? std::stod(argv[2]) : 60.0;
  limits.messages = argc > 3 ? std::stoull(argv[3]) : 1'000'000'000;
  const std::uint64_t seed = argc > 4 ? std::stoull(argv[4]) : 1;
  const FuzzReport report = fuzzNode(argv[1], seed, limits);
  LoneRos::end();
  fmt::print("seed {}: slowest message {:.2f} s, memory grew by {:.0f} MB\n", seed, report.slowest_s,
             report.grown_mb);
  fmt::print("Done {} runs in {:.0f} second(s)\n", report.messages, report.seconds);
  if (report.fault.empty()) return 0;
  fmt::print("FAULT: {}\n", report.fault);
  return 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "fuzz_messages: {}\n", error.what());
  return 2;
}
