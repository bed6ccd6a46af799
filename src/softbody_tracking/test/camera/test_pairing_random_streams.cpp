#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include "camera/pairing_run.h"

namespace softbody {
namespace {

/// An image on its way to the pairer.
struct Event {
  Nanoseconds arrival, stamp;
  bool is_depth;
};

PairingRun runOf(std::vector<Event> events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  PairingRun run;
  for (const Event& event : events) run.add(event.stamp, event.is_depth);
  run.take(true);
  return run;
}

/// Two streams at 30 Hz with an offset, jitter of their stamps, lost images and transport delays. Each
/// stream arrives in the order of its stamps, as over one connection.
std::vector<Event> randomStreams(std::mt19937* random, Nanoseconds offset, Nanoseconds jitter, double lost,
                                 Nanoseconds largest_delay) {
  std::uniform_int_distribution<Nanoseconds> stamp_noise(-jitter, jitter), delay(0, largest_delay);
  std::bernoulli_distribution is_lost(lost);
  std::vector<Event> events;
  for (const bool is_depth : {false, true}) {
    Nanoseconds last_arrival = 0;
    for (int i = 0; i < 300; ++i) {
      const Nanoseconds stamp = kStart + i * kFrame + (is_depth ? offset : 0) + stamp_noise(*random);
      if (is_lost(*random)) continue;
      last_arrival = std::max(last_arrival + 1, stamp + delay(*random));
      events.push_back({last_arrival, stamp, is_depth});
    }
  }
  return events;
}

Nanoseconds nearestTo(Nanoseconds stamp, const std::vector<Nanoseconds>& stamps) {
  return *std::min_element(stamps.begin(), stamps.end(), [stamp](Nanoseconds a, Nanoseconds b) {
    return std::llabs(a - stamp) < std::llabs(b - stamp);
  });
}

TEST(FramePairer, FramesHoldTheirInvariantsInRandomStreams) {
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    const Nanoseconds offset = std::uniform_int_distribution<Nanoseconds>(-14'000'000, 14'000'000)(random);
    const double lost = std::uniform_real_distribution<double>(0.0, 0.4)(random);
    const std::vector<Event> events = randomStreams(&random, offset, 4'000'000, lost, 60'000'000);
    const PairingRun run = runOf(events);
    std::vector<Nanoseconds> colors, depths;
    for (const Event& event : events) (event.is_depth ? depths : colors).push_back(event.stamp);
    Nanoseconds last = 0;
    std::set<Nanoseconds> used, paired;
    for (const Pairer::Frame& frame : run.frames)
      if (frame.depth) paired.insert(*frame.depth);
    int with_depth = 0;
    for (const Pairer::Frame& frame : run.frames) {
      EXPECT_GT(frame.stamp, last);
      last = frame.stamp;
      if (!frame.depth) continue;
      ++with_depth;
      EXPECT_LE(std::llabs(*frame.depth - frame.stamp), kTolerance);
      EXPECT_TRUE(used.insert(*frame.depth).second) << "a depth image in two frames";
      const Nanoseconds nearest_depth = nearestTo(frame.stamp, depths);
      EXPECT_TRUE(nearest_depth == *frame.depth || paired.count(nearest_depth) != 0) << round;
      const Nanoseconds nearest_color = nearestTo(*frame.depth, colors);
      EXPECT_TRUE(nearest_color == frame.stamp || nearestTo(nearest_color, depths) != *frame.depth) << round;
    }
    const UnpairedImages unpaired = run.pairer.unpaired();
    EXPECT_EQ(unpaired.colors_alone + static_cast<int>(run.frames.size()), static_cast<int>(colors.size()));
    EXPECT_EQ(unpaired.depths_alone + with_depth, static_cast<int>(depths.size()));
  }
}

TEST(FramePairer, TransportDelaysDoNotChangeTheFrames) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const Nanoseconds offset = std::uniform_int_distribution<Nanoseconds>(-15'000'000, 15'000'000)(random);
    std::vector<Event> events = randomStreams(&random, offset, 3'000'000, 0.1, 0);
    const PairingRun direct = runOf(events);
    std::uniform_int_distribution<Nanoseconds> delay(0, 50'000'000);
    Nanoseconds last[2] = {0, 0};
    for (Event& event : events)
      last[event.is_depth] = event.arrival =
          std::max(last[event.is_depth] + 1, event.arrival + delay(random));
    const PairingRun delayed = runOf(events);
    ASSERT_EQ(direct.frames.size(), delayed.frames.size()) << round;
    for (std::size_t i = 0; i < direct.frames.size(); ++i) {
      EXPECT_EQ(direct.frames[i].stamp, delayed.frames[i].stamp);
      ASSERT_EQ(direct.frames[i].depth != nullptr, delayed.frames[i].depth != nullptr) << round << " " << i;
      if (direct.frames[i].depth) {
        EXPECT_EQ(*direct.frames[i].depth, *delayed.frames[i].depth);
      }
    }
  }
}

}  // namespace
}  // namespace softbody
