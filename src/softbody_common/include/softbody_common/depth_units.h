#pragma once

namespace softbody {

/// Units of depth images that cameras and data sets use [m]: metre, centimetre, millimetre, half of it, and
/// those of RealSense L515 (0.25 mm), SR300 (0.125 mm), D405 (0.1 mm) and of the TUM data set (0.2 mm).
constexpr double kDepthUnits_m[] = {1.0, 0.01, 0.001, 0.0005, 0.00025, 0.0002, 0.000125, 0.0001};

}  // namespace softbody
