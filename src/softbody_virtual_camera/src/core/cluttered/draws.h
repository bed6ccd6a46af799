#pragma once

#include <cstdint>

#include "softbody_common/statistics/random.h"

namespace softbody::virtual_camera {

/// What a scene chooses by chance, one value after the other. The same seed gives the same values.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}

  double between(double low, double high) { return low + (high - low) * unit(next()); }
  /// 0 to count - 1.
  int below(int count) { return static_cast<int>(unit(next()) * count); }
  /// 1 or -1.
  double sign() { return below(2) == 0 ? -1.0 : 1.0; }
  std::uint64_t next() { return hash(seed_, ++drawn_); }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

}  // namespace softbody::virtual_camera
