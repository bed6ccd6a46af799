#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "softbody_recordings/pairing/frame_pairer.h"

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

TEST(FramePairer, PairsEqualStampsWhicheverComesFirst) {
  Pairer pairer(kTolerance);
  std::vector<Pairer::Pair> pairs;
  for (int i = 0; i < 30; ++i) {
    const Nanoseconds stamp = i * kFrame;
    if (i % 2 == 0) pairer.addColor(stamp, imageAt(stamp));
    pairer.addDepth(stamp, imageAt(stamp));
    if (i % 2 == 1) pairer.addColor(stamp, imageAt(stamp));
    for (const Pairer::Pair& pair : drain(&pairer, false)) pairs.push_back(pair);
  }
  EXPECT_GT(pairs.size(), 15u) << "only a few images wait for late ones";
  for (const Pairer::Pair& pair : drain(&pairer, true)) pairs.push_back(pair);
  ASSERT_EQ(pairs.size(), 30u);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(*pairs[i].color, i * kFrame);
    EXPECT_EQ(*pairs[i].depth, i * kFrame);
  }
}

TEST(FramePairer, PutsLateImagesInTheirPlaceAndARestartWhereItIs) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> lateness(0, 8);
  std::vector<std::pair<int, int>> arrivals;  // when, frame
  for (int i = 0; i < 200; ++i) arrivals.emplace_back(i + lateness(random), i);
  std::stable_sort(arrivals.begin(), arrivals.end());
  Pairer pairer(kTolerance);
  std::vector<Pairer::Pair> pairs;
  for (int pass = 0; pass < 2; ++pass) {
    for (const auto& [when, frame] : arrivals) {
      pairer.addColor(frame * kFrame, imageAt(frame));
      pairer.addDepth(frame * kFrame, imageAt(frame));
      for (const Pairer::Pair& pair : drain(&pairer, false)) pairs.push_back(pair);
    }
  }
  for (const Pairer::Pair& pair : drain(&pairer, true)) pairs.push_back(pair);
  ASSERT_EQ(pairs.size(), 400u);
  for (int i = 0; i < 400; ++i) {
    EXPECT_EQ(*pairs[i].color, i % 200);
    ASSERT_TRUE(pairs[i].depth) << i;
    EXPECT_EQ(*pairs[i].depth, i % 200);
  }
}

TEST(FramePairer, TakesEachStampOnceWithItsDepthWhicheverStreamRepeatsIt) {
  std::mt19937 random(11);
  std::bernoulli_distribution twice(0.3);
  Pairer pairer(kTolerance);
  std::vector<Pairer::Pair> pairs;
  int colors_again = 0, depths_again = 0;
  for (int i = 0; i < 200; ++i) {
    const bool color_again = twice(random), depth_again = twice(random);
    colors_again += color_again ? 1 : 0;
    depths_again += depth_again ? 1 : 0;
    for (int k = 0; k < (color_again ? 2 : 1); ++k) pairer.addColor(i * kFrame, imageAt(i));
    for (int k = 0; k < (depth_again ? 2 : 1); ++k) pairer.addDepth(i * kFrame, imageAt(i));
    for (const Pairer::Pair& pair : drain(&pairer, false)) pairs.push_back(pair);
  }
  for (const Pairer::Pair& pair : drain(&pairer, true)) pairs.push_back(pair);
  EXPECT_EQ(pairer.leftOut().colors_again, colors_again);
  EXPECT_EQ(pairer.leftOut().depths_again, depths_again);
  EXPECT_EQ(pairer.leftOut().depths_alone, 0);
  ASSERT_EQ(pairs.size(), 200u);
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(*pairs[i].color, i);
    ASSERT_TRUE(pairs[i].depth) << i;
    EXPECT_EQ(*pairs[i].depth, i);
  }
}

TEST(FramePairer, CountsEveryDepthImageThatIsInNoPair) {
  std::mt19937 random(12);
  std::bernoulli_distribution lost(0.2);
  for (Nanoseconds offset : {0, 5'000'000, 16'000'000}) {  // the last beyond the tolerance
    Pairer pairer(kTolerance);
    int depths = 0, pairs = 0, paired = 0;
    const auto count = [&](bool finish) {
      for (const Pairer::Pair& pair : drain(&pairer, finish)) {
        ++pairs;
        paired += pair.depth ? 1 : 0;
      }
    };
    for (int i = 0; i < 200; ++i) {
      if (!lost(random)) pairer.addColor(i * kFrame, imageAt(i));
      pairer.addDepth(i * kFrame + offset, imageAt(i)), ++depths;
      count(false);
    }
    count(true);
    EXPECT_EQ(pairer.leftOut().depths_alone, depths - paired) << offset;
    EXPECT_EQ(paired, offset > kTolerance ? 0 : pairs) << offset;
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

TEST(FramePairer, OneDroppedDepthImageLeavesTheOtherPairsAlone) {
  for (Nanoseconds offset : {-3'000'000, 0, 2'000'000}) {
    constexpr Nanoseconds kShort = 11'111'111;  // shorter than the tolerance
    Pairer pairer(kTolerance);
    std::vector<Pairer::Pair> pairs;
    for (int i = 0; i < 200; ++i) {
      pairer.addColor(i * kShort, imageAt(i));
      if (i != 10) pairer.addDepth(i * kShort + offset, imageAt(i));
      for (const Pairer::Pair& pair : drain(&pairer, false)) pairs.push_back(pair);
    }
    for (const Pairer::Pair& pair : drain(&pairer, true)) pairs.push_back(pair);
    ASSERT_EQ(pairs.size(), 200u);
    int wrong = 0;
    for (const Pairer::Pair& pair : pairs) wrong += pair.depth && *pair.depth != *pair.color ? 1 : 0;
    EXPECT_LE(wrong, 1) << "offset " << offset;
  }
}

TEST(FramePairer, HoldsFewImagesWhenTheClocksDisagree) {
  Pairer pairer(kTolerance);
  std::vector<std::weak_ptr<Nanoseconds>> images;
  for (int i = 0; i < 500; ++i) {
    const Image color = imageAt(i), depth = imageAt(i);
    images.insert(images.end(), {color, depth});
    pairer.addColor(i * kFrame, color);
    pairer.addDepth(i * kFrame - 1'000'000'000, depth);
    drain(&pairer, false);
  }
  const auto alive =
      std::count_if(images.begin(), images.end(), [](const auto& image) { return !image.expired(); });
  EXPECT_LE(alive, 80);
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
