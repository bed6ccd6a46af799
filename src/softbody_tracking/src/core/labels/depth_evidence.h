#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace softbody {

/// What is farther than the predicted surface by more than this [m] is behind it; above noise and slope.
constexpr double kBehindSurface = 0.01;

/// Step of depth between neighbouring pixels or cells at which a surface ends [m]; far above noise.
constexpr double kSurfaceEnds = 0.02;

/// Largest log odds of one pixel by depth: any pixel may be wrong, and depth is ragged at edges.
constexpr float kDepthLimit = 1.5f;

/// Differences of depth of pixels that do not show the body.
struct DepthCounts {
  static constexpr int kBins = 32;         // as wide as the table of DepthEvidence
  static constexpr double kWidth = 0.004;  ///< of a bin [m]; the middle of all is 0

  std::array<float, kBins> pixels{};
  float all = 0.0f;  ///< also those outside of all bins

  /// @param scaled difference, see DepthEvidence::scaled().
  void add(double scaled, float weight);
  /// Takes a share of the newest counts.
  void blend(const DepthCounts& newest, float share);
};

/// How much the depth of a pixel speaks for the body, where the body is predicted. What is not the body has
/// the depth that was seen before; as long as nothing was, it is anywhere within a metre, or touches the body
/// like the table below it.
class DepthEvidence {
 public:
  DepthEvidence() { compare({}); }
  /// @param around what is not the body.
  void compare(const DepthCounts& around);

  /// A difference as at up to 1 m; beyond, the deviation grows with the distance.
  static float scaled(float difference, float predicted) {
    return predicted > 1.0f ? difference / predicted : difference;
  }
  /// Log odds of the body against everything else. @param difference measured minus predicted depth [m].
  /// @param predicted depth of the body [m].
  float logOdds(float difference, float predicted) const {
    const float cell = scaled(difference, predicted) * kPerMetre + kZero;
    return table_[static_cast<std::size_t>(std::clamp(cell, 0.0f, 2.0f * kHalf))];
  }

  /// The same where another part of the body is predicted behind. @param behind its depth [m].
  static double logOddsBefore(double behind, double measured, double predicted);

  /// The same for a surface that is the body or something before it, which touches it or not.
  /// @param deviation of the body's depth around the prediction [m].
  static double logOddsBeforeBody(double difference, double deviation);

 private:
  static constexpr int kHalf = 128;             // cells on each side
  static constexpr float kZero = kHalf + 0.5f;  // the difference 0 is in the middle of cell kHalf
  static constexpr float kPerMetre = 2000.0f;   // cells
  using Table = std::array<double, 2 * kHalf + 1>;
  static Table tableOf(double (*density)(double difference));

  std::array<float, 2 * kHalf + 1> table_;
};

}  // namespace softbody
