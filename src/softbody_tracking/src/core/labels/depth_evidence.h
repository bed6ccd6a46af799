#pragma once

#include <array>
#include <cstddef>

namespace softbody {

/// What is farther than the predicted surface by more than this [m] is behind it; above noise and slope.
constexpr double kBehindSurface = 0.01;

/// Step of depth between neighbouring pixels or cells at which a surface ends [m]; far above noise.
constexpr double kSurfaceEnds = 0.02;

/// Largest log odds of one pixel by depth: any pixel may be wrong, and depth is ragged at edges.
constexpr double kDepthLimit = 1.5;

/// How much the depth of a pixel speaks for the body, where the body is predicted. What is not the body is
/// anywhere within a metre, or touches the body like the table below it.
class DepthEvidence {
 public:
  /// Log odds of the body against everything else. @param difference measured minus predicted depth [m].
  /// @param predicted depth of the body [m]; beyond 1 m the deviation grows with the distance.
  static double logOdds(double difference, double predicted) {
    const double scaled = predicted > 1.0 ? difference / predicted : difference;
    const auto cell = static_cast<int>(scaled / kCell + kZero);
    return cell < 0 ? kTable.front() : kTable[static_cast<std::size_t>(cell < 2 * kHalf ? cell : 2 * kHalf)];
  }

  /// The same where another part of the body is predicted behind. @param behind its depth [m].
  static double logOddsBefore(double behind, double measured, double predicted);

  /// The same for a surface that is the body or something before it, which touches it or not.
  /// @param deviation of the body's depth around the prediction [m].
  static double logOddsBeforeBody(double difference, double deviation);

 private:
  static constexpr int kHalf = 128;             // cells on each side
  static constexpr double kZero = kHalf + 0.5;  // the difference 0 is in the middle of cell kHalf
  static constexpr double kCell = 0.0005;       // [m]
  static const std::array<double, 2 * kHalf + 1> kTable;
  static std::array<double, 2 * kHalf + 1> makeTable();
};

}  // namespace softbody
