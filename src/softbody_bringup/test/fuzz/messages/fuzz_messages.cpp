#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/fuzz_run.h"
#include "fuzz/messages/target.h"

/// Usage: fuzz_messages NODE [MESSAGES [SEED]]. Without arguments it prints the nodes.
/// Exit code: 0 no fault, 1 a fault, 2 wrong usage.
int main(int argc, char** argv) try {
  using namespace softbody::fuzz;
  if (argc < 2) {
    for (const TargetKind& kind : targetKinds()) fmt::print("{}\n", kind.name);
    return 0;
  }
  const std::size_t messages = argc > 2 ? std::stoull(argv[2]) : 1'000'000;
  const std::uint64_t seed = argc > 3 ? std::stoull(argv[3]) : 1;
  const FuzzReport report = fuzzNode(argv[1], seed, messages);
  LoneRos::end();
  fmt::print("{} messages in {:.0f} s, the slowest in {:.2f} s; memory grew by {:.0f} MB\n", report.messages,
             report.seconds, report.slowest_s, report.grown_mb);
  if (report.fault.empty()) return 0;
  fmt::print("FAULT: {}\n", report.fault);
  return 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "fuzz_messages: {}\n", error.what());
  return 2;
}
