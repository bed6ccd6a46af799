#include "camera/mask_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace softbody {
namespace {

using Queue = MaskQueue<int, int>;

constexpr double kPatience = 0.5;

TEST(MaskQueue, AFrameWaitsForItsMask) {
  Queue queue(kPatience);
  queue.addFrame(100, 1, 0.0);
  EXPECT_FALSE(queue.ready(0.4));
  queue.addMask(100, 7);
  const auto ready = queue.ready(0.4);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->frame, 1);
  EXPECT_EQ(ready->mask, 7);
  EXPECT_FALSE(queue.ready(9.0));
}

TEST(MaskQueue, AMaskMayComeFirst) {
  Queue queue(kPatience);
  queue.addMask(100, 7);
  queue.addFrame(100, 1, 0.0);
  const auto ready = queue.ready(0.0);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->mask, 7);
}

TEST(MaskQueue, WithoutItsMaskAFrameLeavesWhenItsTimeIsUp) {
  Queue queue(kPatience);
  queue.addMask(50, 7);
  queue.addFrame(100, 1, 0.0);
  queue.addFrame(200, 2, 0.1);
  EXPECT_FALSE(queue.ready(0.49));
  const auto ready = queue.ready(0.51);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->frame, 1);
  EXPECT_FALSE(ready->mask);
  EXPECT_FALSE(queue.ready(0.51)) << "the second came later";
}

TEST(MaskQueue, TheMaskOfALaterFrameEndsTheWait) {
  Queue queue(kPatience);
  for (int k = 1; k <= 3; ++k) queue.addFrame(100 * k, k, 0.0);
  queue.addMask(300, 7);
  std::vector<int> frames;
  while (const auto ready = queue.ready(0.0)) {
    frames.push_back(ready->frame);
    EXPECT_EQ(ready->mask.has_value(), ready->frame == 3);
  }
  EXPECT_EQ(frames, (std::vector<int>{1, 2, 3}));
}

TEST(MaskQueue, WhatIsLeftOfAPassOfABagDoesNotEndTheWaitInTheNext) {
  Queue queue(kPatience);
  for (int k = 7; k <= 9; ++k) {
    queue.addFrame(100 * k, k, 0.0);
    queue.addMask(100 * k, k);
  }
  ASSERT_TRUE(queue.ready(0.0));
  queue.forgetFrames();
  queue.addFrame(100, 1, 0.0);
  EXPECT_FALSE(queue.ready(0.1)) << "the masks of the last pass are void, and so are its frames";
  queue.addMask(100, 5);
  const auto ready = queue.ready(0.1);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->frame, 1);
  EXPECT_EQ(ready->mask, 5);
}

TEST(MaskQueue, AMaskOfTheNextPassMayComeBeforeItsFrame) {
  Queue queue(kPatience);
  queue.addFrame(900, 9, 0.0);
  queue.addMask(900, 9);
  ASSERT_TRUE(queue.ready(0.0));
  queue.addMask(100, 5);
  queue.addFrame(100, 1, 0.0);
  const auto ready = queue.ready(0.0);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->mask, 5);
}

TEST(MaskQueue, AMaskWithAStampOfNoFrameEndsNoWait) {
  Queue queue(kPatience);
  queue.addMask(4'294'967'295'000'000'000, 9);
  queue.addFrame(100, 1, 0.0);
  EXPECT_FALSE(queue.ready(0.1));
  queue.addMask(100, 5);
  const auto ready = queue.ready(0.1);
  ASSERT_TRUE(ready);
  EXPECT_EQ(ready->mask, 5);
}

TEST(MaskQueue, MasksThatCameInAnyOrderBeforeTheirFramesAreUsed) {
  constexpr Nanoseconds kFrame = 33'000'000;
  std::vector<int> order{1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    Queue queue(kPatience);
    for (const int k : order) queue.addMask(k * kFrame, k);
    for (int k = 1; k <= 9; ++k) {
      queue.addFrame(k * kFrame, k, 0.0);
      const auto ready = queue.ready(0.0);
      ASSERT_TRUE(ready);
      EXPECT_EQ(ready->mask, k);
    }
  }
}

TEST(MaskQueue, EveryFrameLeavesOnceInOrderWithItsOwnMaskOrNone) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const auto chance = [&](double p) { return std::bernoulli_distribution(p)(random); };
    Queue queue(kPatience);
    std::vector<int> frames;
    int masked = 0, segmented = 0;
    double now = 0.0;
    const auto take = [&] {
      while (const auto ready = queue.ready(now)) {
        frames.push_back(ready->frame);
        if (!ready->mask) continue;
        EXPECT_EQ(*ready->mask, ready->frame);
        ++masked;
      }
    };
    const int delay = std::uniform_int_distribution<int>(-3, 10)(random);
    std::vector<int> expected;
    for (int k = 1; k <= 100; ++k, now += 0.033) {
      queue.addFrame(1000 * k, k, now);
      expected.push_back(k);
      const int of = k - delay;
      if (of >= 1 && chance(0.6)) queue.addMask(1000 * of, of), segmented += of <= 100 ? 1 : 0;
      take();
    }
    now += kPatience + 1.0;
    take();
    EXPECT_EQ(frames, expected) << "seed " << seed;
    EXPECT_EQ(masked, segmented) << "seed " << seed;
  }
}

}  // namespace
}  // namespace softbody
