#pragma once

namespace softbody {

/// The standard deviation of corners as the residuals of the last frames show it. Print, blur and light make
/// corners worse than the configured value. Poses from corners that are trusted too much look certain, and
/// two poses that fit equally well look different.
class CornerNoise {
 public:
  /// @param std_px the configured standard deviation, below which the estimate never falls.
  explicit CornerNoise(double std_px) : configured_px_(std_px) {}

  double std_px() const;
  /// Degrees of freedom behind the estimate: how well it is known.
  double freedom() const;
  /// Takes the fit of one frame. @param cost chi squared of its corners, with std_px() of that frame.
  /// @param freedom coordinates of corners minus the pose's parameters that they determine.
  void add(double cost, double freedom);

 private:
  double configured_px_;
  double sum_ = 0.0;  ///< of chi squared, for the configured standard deviation; old frames count less
  double freedom_ = 0.0;
};

}  // namespace softbody
