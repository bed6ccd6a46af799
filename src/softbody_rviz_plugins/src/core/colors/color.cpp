#include "colors/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody {
namespace {

constexpr Color kUnknown{130, 130, 130, 255};
constexpr double kCounted = 0.995;  // fraction of the values that the scale covers
constexpr double kFarBelow = 0.4;   // of the scale
constexpr double kSmallestScale = 1e-6;
constexpr double kMostSteps = 5.0;  // between the ticks of a scale

/// Every 17th of the 256 colours of Viridis (van der Walt and Smith 2015) and Cividis (Nuñez, Anderton and
/// Renslow 2018), as matplotlib has them. Between them the colour is linear.
constexpr int kColors = 16;
using ColorTable = std::array<Color, kColors>;
constexpr ColorTable kViridis{{{68, 1, 84},
                               {72, 26, 108},
                               {71, 47, 125},
                               {65, 68, 135},
                               {57, 86, 140},
                               {49, 104, 142},
                               {42, 120, 142},
                               {35, 136, 142},
                               {31, 152, 139},
                               {34, 168, 132},
                               {53, 183, 121},
                               {84, 197, 104},
                               {122, 209, 81},
                               {165, 219, 54},
                               {210, 226, 27},
                               {253, 231, 37}}};
constexpr ColorTable kCividis{{{0, 34, 78},
                               {0, 46, 108},
                               {30, 58, 111},
                               {53, 69, 108},
                               {71, 81, 108},
                               {87, 93, 109},
                               {102, 105, 112},
                               {117, 117, 117},
                               {132, 130, 121},
                               {148, 142, 119},
                               {165, 156, 116},
                               {183, 169, 110},
                               {200, 184, 102},
                               {219, 199, 90},
                               {238, 214, 73},
                               {254, 232, 56}}};

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
}

/// The least of 1, 2, 5 times a power of ten that is not below the value.
double roundedUp(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

Color colorOf(ColorMap map, double value) {
  if (std::isnan(value)) return kUnknown;
  const ColorTable& table = map == ColorMap::kViridis ? kViridis : kCividis;
  const double place = std::clamp(value, 0.0, 1.0) * (kColors - 1);
  const int below = std::min(static_cast<int>(place), kColors - 2);
  const Color &a = table[below], &b = table[below + 1];
  const double share = place - below;
  return {mixed(a.red, b.red, share), mixed(a.green, b.green, share), mixed(a.blue, b.blue, share), 255};
}

Color pieceColor(std::uint32_t piece) {
  // Okabe and Ito 2008.
  constexpr std::array<Color, 8> kColors{{{86, 180, 233},
                                          {230, 159, 0},
                                          {0, 158, 115},
                                          {204, 121, 167},
                                          {240, 228, 66},
                                          {0, 114, 178},
                                          {213, 94, 0},
                                          {153, 153, 153}}};
  return kColors[piece % kColors.size()];
}

std::vector<Color> colorsOf(ColorMap map, const std::vector<float>& values, double maximum) {
  std::vector<Color> colors;
  colors.reserve(values.size());
  for (const float value : values) colors.push_back(colorOf(map, value / maximum));
  return colors;
}

double ScaleMaximum::follow(const std::vector<float>& values) {
  std::vector<float> numbers;
  std::copy_if(values.begin(), values.end(), std::back_inserter(numbers),
               [](float value) { return std::isfinite(value); });
  double reached = kSmallestScale;
  if (!numbers.empty()) {
    const auto place =
        numbers.begin() + static_cast<std::ptrdiff_t>(kCounted * static_cast<double>(numbers.size() - 1));
    std::nth_element(numbers.begin(), place, numbers.end());
    reached = std::max<double>(reached, *place);
  }
  if (reached > maximum_ || reached < kFarBelow * maximum_) maximum_ = roundedUp(reached);
  return maximum_;
}

std::vector<double> ticksOf(double maximum) {
  const double step = roundedUp(maximum / kMostSteps);
  std::vector<double> ticks;
  for (int k = 0; k * step <= maximum * (1.0 + 1e-9); ++k) ticks.push_back(k * step);
  return ticks;
}

}  // namespace softbody
