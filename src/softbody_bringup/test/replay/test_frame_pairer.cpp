#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "softbody_bringup/frame_pairer.h"

namespace softbody {
namespace {

using Image = std::shared_ptr<Nanoseconds>;
using Pairer = FramePairer<Image, Image>;

constexpr Nanoseconds kFrame = 33'333'333, kTolerance = 15'000'000;

Image imageAt(Nanoseconds stamp) { return std::make_shared<Nanoseconds>(stamp); }

std::vector<Pairer::Pair> drain(Pairer* pairer, bool finish) {
  std::vector<Pairer::Pair> pairs;
  while (const auto pair = pairer->next(finish)) pairs.push_back(*pair);
  return pairs;
}

TEST(FramePairer, PairsEqualStampsAtOnceWhicheverComesFirst) {
  Pairer pairer(kTolerance);
  for (int i = 0; i < 10; ++i) {
    const Nanoseconds stamp = i * kFrame;
    if (i % 2 == 0) pairer.addColor(stamp, imageAt(stamp));
    pairer.addDepth(stamp, imageAt(stamp));
    if (i % 2 == 1) pairer.addColor(stamp, imageAt(stamp));
    const auto pairs = drain(&pairer, false);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(*pairs[0].color, stamp);
    EXPECT_EQ(*pairs[0].depth, stamp);
  }
}

TEST(FramePairer, KeepsEveryColorImageInOrderWhateverDepthDoes) {
  std::mt19937 random(10);
  std::uniform_int_distribution<Nanoseconds> jitter(-12'000'000, 12'000'000);
  std::bernoulli_distribution lost(0.3);
  Pairer pairer(kTolerance);
  std::vector<Pairer::Pair> pairs;
  for (int i = 0; i < 300; ++i) {
    const Nanoseconds stamp = i * kFrame;
    pairer.addColor(stamp, imageAt(stamp));
    if (!lost(random)) {
      const Nanoseconds depth_stamp = stamp + jitter(random);
      pairer.addDepth(depth_stamp, imageAt(depth_stamp));
    }
    for (const Pairer::Pair& pair : drain(&pairer, false)) pairs.push_back(pair);
  }
  for (const Pairer::Pair& pair : drain(&pairer, true)) pairs.push_back(pair);
  ASSERT_EQ(pairs.size(), 300u);
  int with_depth = 0;
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(*pairs[i].color, i * kFrame);
    if (!pairs[i].depth) continue;
    ++with_depth;
    EXPECT_LE(std::llabs(*pairs[i].depth - pairs[i].stamp), kTolerance);
  }
  EXPECT_GT(with_depth, 180);
}

TEST(FramePairer, DoesNotHoldColorBackWhenDepthIsSilent) {
  Pairer pairer(kTolerance);
  std::size_t released = 0;
  for (int i = 0; i < 100; ++i) {
    pairer.addColor(i * kFrame, imageAt(i));
    for (const Pairer::Pair& pair : drain(&pairer, false)) {
      EXPECT_EQ(pair.depth, nullptr);
      ++released;
    }
  }
  EXPECT_GE(released, 60u);
}

}  // namespace
}  // namespace softbody
