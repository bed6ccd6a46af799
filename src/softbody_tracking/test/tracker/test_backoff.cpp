#include "tracker/backoff.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace softbody {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

/// The times [s] of the frames in which a try is due, and fails. @param jitter_s of the stamps.
std::vector<double> triesAt(Backoff* backoff, int rate, double duration_s, double jitter_s = 0.0) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-jitter_s, jitter_s);
  std::vector<double> tries;
  for (int i = 0; i < duration_s * rate; ++i) {
    const double now = static_cast<double>(i) / rate;
    if (!backoff->isDue(kSecond + nanoseconds(now + uniform(random)))) continue;
    backoff->failed();
    tries.push_back(now);
  }
  return tries;
}

TEST(Backoff, WaitsLongerAfterEachFailure) {
  for (const double jitter_s : {0.0, 0.001}) {
    Backoff backoff;
    std::vector<int> frames;
    for (const double time : triesAt(&backoff, 30, 1.3, jitter_s))
      frames.push_back(static_cast<int>(30 * time + 0.5));
    EXPECT_EQ(frames, std::vector<int>({0, 2, 6, 14, 25, 36}));
  }
}

/// A try is at most two frames later or earlier than at 30 Hz for each try before it.
TEST(Backoff, WaitsTheSameTimeAtAnyRate) {
  Backoff usual;
  const std::vector<double> expected = triesAt(&usual, 30, 10.0);
  for (const int rate : {10, 15, 25, 60, 90}) {
    Backoff backoff;
    const std::vector<double> tries = triesAt(&backoff, rate, 10.0);
    EXPECT_NEAR(static_cast<double>(tries.size()), static_cast<double>(expected.size()),
                0.25 * expected.size());
    for (std::size_t i = 1; i < tries.size(); ++i) {
      EXPECT_GE(tries[i] - tries[i - 1], 1e-9 * std::min<Nanoseconds>(30'000'000, kLongestGap)) << rate;
      EXPECT_LE(tries[i] - tries[i - 1], 1e-9 * kLongestGap + 2.0 / rate + 1e-9) << rate;
    }
  }
}

TEST(Backoff, TriesAtOnceAfterASuccess) {
  Backoff backoff;
  triesAt(&backoff, 30, 0.6);
  backoff.reset();
  EXPECT_TRUE(backoff.isDue(0)) << "also if the stamps start again";
}

/// A try that takes a second is followed by a wait.
TEST(Backoff, TheWaitBeginsAfterTheTry) {
  Backoff backoff;
  for (Nanoseconds stamp = kSecond; stamp < 10 * kSecond; stamp += kSecond) {
    EXPECT_TRUE(backoff.isDue(stamp));
    backoff.failed();
    EXPECT_FALSE(backoff.isDue(stamp += 33'333'333));
  }
}

TEST(Backoff, WaitsAsLongAsAsked) {
  Backoff backoff(kLatestTime);
  const std::vector<double> tries = triesAt(&backoff, 30, 100.0);
  EXPECT_LE(tries.size(), 13u);
  EXPECT_GT(tries[12] - tries[11], tries[11] - tries[10]);
}

}  // namespace
}  // namespace softbody
