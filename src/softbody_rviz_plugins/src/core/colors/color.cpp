#include "colors/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody {
namespace {

using Rgb = std::array<double, 3>;

constexpr Color kUnknown{130, 130, 130, 255};
constexpr double kCounted = 0.995;  // fraction of the values that the scale covers
constexpr double kFarBelow = 0.4;   // of the scale
constexpr double kSmallestScale = 1e-6;

/// Coefficients of the powers 0, 1, ... of the value.
/// Viridis (van der Walt and Smith 2015), polynomials by M. Zucker.
constexpr std::array<Rgb, 7> kViridis{{{0.2777, 0.0054, 0.3341},
                                       {0.1051, 1.4046, 1.3846},
                                       {-0.3309, 0.2148, 0.0951},
                                       {-4.6342, -5.7991, -19.3324},
                                       {6.2283, 14.1799, 56.6906},
                                       {4.7764, -13.7451, -65.3530},
                                       {-5.4355, 4.6459, 26.3124}}};
/// Turbo and its polynomials (Mikhailov 2019).
constexpr std::array<Rgb, 7> kTurbo{{{0.1357, 0.0914, 0.1067},
                                     {4.6154, 2.1942, 12.6419},
                                     {-42.6603, 4.8430, -60.5820},
                                     {132.1311, -14.1850, 110.3628},
                                     {-152.9424, 4.2773, -89.9031},
                                     {59.2864, 2.8296, 27.3482},
                                     {0.0, 0.0, 0.0}}};

std::uint8_t toByte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
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
  const auto& coefficients = map == ColorMap::kViridis ? kViridis : kTurbo;
  const double t = std::clamp(value, 0.0, 1.0);
  Rgb rgb{};
  for (std::size_t power = coefficients.size(); power-- > 0;) {
    for (int c = 0; c < 3; ++c) rgb[c] = rgb[c] * t + coefficients[power][c];
  }
  return {toByte(rgb[0]), toByte(rgb[1]), toByte(rgb[2]), 255};
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

}  // namespace softbody
