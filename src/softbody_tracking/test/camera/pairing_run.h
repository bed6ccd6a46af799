#pragma once

#include <memory>
#include <vector>

#include "softbody_tracking/camera/frame_pairer.h"

namespace softbody {

/// An image of which nothing but its stamp matters.
using Image = std::shared_ptr<Nanoseconds>;
using Pairer = FramePairer<Image, Image, Image>;

inline constexpr Nanoseconds kStart = 1'000'000'000, kFrame = 33'333'333, kTolerance = 15'000'000;

inline Image imageAt(Nanoseconds stamp) { return std::make_shared<Nanoseconds>(stamp); }

inline Pairer startedPairer(const PairingConfig& config = {}) {
  Pairer pairer(config);
  pairer.setInfo(imageAt(0));
  return pairer;
}

/// A pairer, and the frames it has given.
struct PairingRun {
  explicit PairingRun(const PairingConfig& config = {}) : pairer(startedPairer(config)) {}

  void add(Nanoseconds stamp, bool is_depth) {
    if (is_depth)
      pairer.addDepth(stamp, imageAt(stamp));
    else
      pairer.addColor(stamp, imageAt(stamp));
    take(false);
  }
  void take(bool finish) {
    while (const auto frame = pairer.next(finish)) frames.push_back(*frame);
  }

  Pairer pairer;
  std::vector<Pairer::Frame> frames;
};

}  // namespace softbody
