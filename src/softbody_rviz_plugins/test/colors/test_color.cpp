#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "colors/color.h"

namespace softbody {
namespace {

double brightness(const Color& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; }

TEST(Color, viridisGetsBrighterAllTheWay) {
  for (int i = 1; i <= 20; ++i)
    EXPECT_GT(brightness(colorOf(ColorMap::kViridis, i / 20.0)),
              brightness(colorOf(ColorMap::kViridis, (i - 1) / 20.0)));
}

TEST(Color, turboGoesFromBlueToRed) {
  const Color low = colorOf(ColorMap::kTurbo, 0.1), high = colorOf(ColorMap::kTurbo, 0.9);
  EXPECT_GT(low.blue, low.red + 50);
  EXPECT_GT(high.red, high.blue + 50);
}

TEST(Color, valuesOutsideTakeTheNearerEndAndNoNumberIsGrey) {
  for (const ColorMap map : {ColorMap::kViridis, ColorMap::kTurbo}) {
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
    const double digit = end / std::pow(10.0, std::floor(std::log10(end) + 1e-9));
    EXPECT_NEAR(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}), 0.0, 1e-6) << end;
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

}  // namespace
}  // namespace softbody
