#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "colors/color.h"

namespace softbody {
namespace {

double brightness(const Color& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

/// Whether a number is 1, 2 or 5 times a power of ten.
bool isShort(double number) {
  const double digit = number / std::pow(10.0, std::floor(std::log10(number) + 1e-9));
  return std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}) < 1e-6;
}

constexpr ColorMap kMaps[] = {ColorMap::kViridis, ColorMap::kCividis};

TEST(Color, everyMapGetsBrighterAllTheWay) {
  for (const ColorMap map : kMaps) {
    for (int i = 1; i <= 100; ++i)
      EXPECT_GT(brightness(colorOf(map, i / 100.0)), brightness(colorOf(map, (i - 1) / 100.0)));
  }
}

TEST(Color, noMapShowsRedAsAnAlarm) {
  for (const ColorMap map : kMaps) {
    for (int i = 0; i <= 100; ++i) {
      const Color color = colorOf(map, i / 100.0);
      EXPECT_LT(color.red, 1.5 * std::max(color.green, color.blue));
    }
  }
}

TEST(Color, aMapHasNoJump) {
  for (const ColorMap map : kMaps) {
    for (int i = 1; i <= 255; ++i) {
      const Color a = colorOf(map, (i - 1) / 255.0), b = colorOf(map, i / 255.0);
      EXPECT_LE(std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue), 8);
    }
  }
}

TEST(Color, valuesOutsideTakeTheNearerEndAndNoNumberIsGrey) {
  for (const ColorMap map : kMaps) {
    EXPECT_EQ(colorOf(map, -3.0), colorOf(map, 0.0));
    EXPECT_EQ(colorOf(map, 3.0), colorOf(map, 1.0));
    const Color none = colorOf(map, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(none.red, none.green);
    EXPECT_EQ(none.green, none.blue);
  }
}

TEST(Color, neighbouringPiecesDiffer) {
  std::set<std::tuple<int, int, int>> colors;
  for (unsigned piece = 0; piece < 8; ++piece) {
    const Color color = pieceColor(piece);
    colors.emplace(color.red, color.green, color.blue);
  }
  EXPECT_EQ(colors.size(), 8u);
}

TEST(ScaleMaximum, coversTheValuesWithAShortNumber) {
  for (double largest = 1e-5; largest < 1e3; largest *= 1.7) {
    ScaleMaximum maximum;
    const double end = maximum.follow(std::vector<float>(100, static_cast<float>(largest)));
    EXPECT_GE(end, largest * (1.0 - 1e-6));
    EXPECT_LE(end, 2.5 * largest * (1.0 + 1e-6));
    EXPECT_TRUE(isShort(end)) << end;
  }
}

TEST(ScaleMaximum, smallChangesDoNotMoveIt) {
  ScaleMaximum maximum;
  const double first = maximum.follow({0.9f});
  for (const float value : {0.8f, 0.95f, 0.6f, 1.0f, 0.5f}) EXPECT_EQ(maximum.follow({value}), first);
  EXPECT_GT(maximum.follow({4.0f}), first);
  EXPECT_LT(maximum.follow({0.1f}), first);
}

TEST(ScaleMaximum, isPositiveWithoutValues) {
  ScaleMaximum maximum;
  EXPECT_GT(maximum.follow({}), 0.0);
  EXPECT_GT(maximum.follow({0.0f, std::numeric_limits<float>::quiet_NaN()}), 0.0);
}

TEST(Ticks, areShortNumbersFromZeroToTheMaximum) {
  for (double maximum = 1e-5; maximum < 1e3; maximum *= 1.3) {
    const std::vector<double> ticks = ticksOf(maximum);
    ASSERT_GE(ticks.size(), 3u) << maximum;
    EXPECT_LE(ticks.size(), 6u);
    EXPECT_EQ(ticks.front(), 0.0);
    EXPECT_LE(ticks.back(), maximum * (1.0 + 1e-6));
    EXPECT_GT(ticks.back() + ticks[1], maximum);
    EXPECT_TRUE(isShort(ticks[1])) << ticks[1];
  }
}

TEST(Ticks, reachTheEndOfAScaleThatFollowsValues) {
  for (const double maximum : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0})
    EXPECT_NEAR(ticksOf(maximum).back(), maximum, 1e-9);
}

}  // namespace
}  // namespace softbody
