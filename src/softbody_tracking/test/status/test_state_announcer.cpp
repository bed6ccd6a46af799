#include <gtest/gtest.h>

#include <vector>

#include "status/state_announcer.h"

namespace softbody {
namespace {

using State = TrackingState;

TrackingStatus statusOf(State state, const std::string& reason = "") {
  TrackingStatus status;
  status.state = state;
  status.reason = reason;
  return status;
}

/// The sentences for a state per frame, at 30 Hz. Warnings begin with "!".
std::vector<std::string> linesFor(const std::vector<std::pair<State, int>>& runs) {
  StateAnnouncer announcer;
  std::vector<std::string> lines;
  int frame = 0;
  for (const auto& [state, count] : runs) {
    for (int k = 0; k < count; ++k) {
      const auto line = announcer.announce(statusOf(state), ++frame / 30.0);
      if (line) lines.push_back((line->warning ? "!" : "") + line->sentence);
    }
  }
  return lines;
}

const std::string kFound = "the tracking state is TRACKING", kLost = "!the tracking state is LOST",
                  kBad = "!the tracking state is DEGRADED";
using Lines = std::vector<std::string>;

TEST(StateAnnouncer, SaysEachChangeOnce) {
  EXPECT_EQ(linesFor({{State::kInitializing, 50},
                      {State::kTracking, 90},
                      {State::kLost, 40},
                      {State::kRecovering, 200},
                      {State::kTracking, 50}}),
            (Lines{kFound, kLost, kFound}));
}

TEST(StateAnnouncer, SaysThatABodyIsLostAtOnce) {
  StateAnnouncer announcer;
  announcer.announce(statusOf(State::kTracking), 0.0);
  const auto line = announcer.announce(statusOf(State::kLost, "no image for 3 s"), 5.0);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->sentence, "the tracking state is LOST: no image for 3 s");
  EXPECT_TRUE(line->warning);
}

TEST(StateAnnouncer, AStateThatFlickersDoesNotFloodTheLogAndItsEndIsSaid) {
  std::vector<std::pair<State, int>> runs;
  for (int k = 0; k < 150; ++k) runs.insert(runs.end(), {{State::kTracking, 1}, {State::kLost, 1}});
  runs.emplace_back(State::kTracking, 40);
  const Lines lines = linesFor(runs);  // eleven seconds
  EXPECT_LE(lines.size(), 12U);
  EXPECT_EQ(lines.back(), kFound);
}

TEST(StateAnnouncer, ABadMomentIsNoNews) {
  EXPECT_EQ(linesFor({{State::kTracking, 60}, {State::kDegraded, 10}, {State::kTracking, 60}}),
            Lines{kFound});
  EXPECT_EQ(linesFor({{State::kTracking, 60}, {State::kDegraded, 60}, {State::kTracking, 60}}),
            (Lines{kFound, kBad, kFound}));
}

TEST(StateAnnouncer, AResetIsFollowedByALine) {
  EXPECT_EQ(linesFor({{State::kTracking, 5}, {State::kInitializing, 1}, {State::kTracking, 5}}),
            (Lines{kFound, kFound}));
}

}  // namespace
}  // namespace softbody
