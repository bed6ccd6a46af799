#pragma once

#include <cmath>

namespace softbody {

/// Over this time [s] appearance and corrections are averaged: some frames tell noise from motion, and a lamp
/// that flickers is followed.
constexpr double kMemory_s = 0.15;
/// The same for errors of depth and prediction [s]: motion changes within two frames.
constexpr double kErrorMemory_s = 0.05;

/// Share of the newest frame in a mean over the last frames, at any frame rate.
/// @param elapsed_s since the frame before; infinite: there was none.
inline double newestShare(double elapsed_s, double memory_s) { return 1.0 - std::exp(-elapsed_s / memory_s); }

}  // namespace softbody
