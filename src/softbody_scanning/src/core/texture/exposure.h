#pragma once

#include "texture/triangle_views.h"

namespace softbody::scanning {

/// By how much brighter than usual each frame shows blue, green and red. The logarithms' mean is zero.
/// Robust least squares on the logarithms of what several frames show of one triangle.
std::vector<cv::Vec3f> exposureGains(const TriangleViews& views, std::size_t frames);

/// Divides the views' colours by the gains.
void divideByGains(const std::vector<cv::Vec3f>& gains, TriangleViews* views);

}  // namespace softbody::scanning
