#pragma once

#include <cstdint>
#include <vector>

namespace softbody {

/// A colour as the graphics card reads it, 0 to 255.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
};

inline bool operator==(const Color& a, const Color& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

/// Maps whose brightness grows with the value. None ends in red, which would look like an alarm.
enum class ColorMap { kViridis, kCividis };

/// The colour of a value from 0 to 1. Other values get the colour of the nearer end, and NaN is grey.
Color colorOf(ColorMap map, double value);

/// The colour of a connected piece; they repeat after eight. Colour-blind people can distinguish them.
Color pieceColor(std::uint32_t piece);

/// Colours of values from 0 to the maximum.
std::vector<Color> colorsOf(ColorMap map, const std::vector<float>& values, double maximum);

/// The upper end of a colour scale for values that change from frame to frame: 1, 2 or 5 times a power of
/// ten, which nearly all values reach at most. It grows at once, and shrinks only when the values are far
/// below it, so that colours do not flicker.
class ScaleMaximum {
 public:
  /// @return the end of the scale for these values, > 0.
  double follow(const std::vector<float>& values);

 private:
  double maximum_ = 0.0;
};

/// Values from 0 on at equal steps of 1, 2 or 5 times a power of ten: at most six, none above the maximum.
/// @param maximum > 0.
std::vector<double> ticksOf(double maximum);

}  // namespace softbody
