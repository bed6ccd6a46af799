#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Corners of a dark quadrilateral on bright ground at sub-pixel precision: a line is fitted to the steepest
/// places of each side's brightness profiles, and neighbouring lines meet in the corners.
/// @param corners good to about reach_px, clockwise in the image. @param reach_px how far to look on both
/// sides of an edge: less than to the next edge inside.
/// @return false, and the corners as they were, where a side shows no edge or a corner would move by more
/// than twice the reach.
bool refineQuadrilateral(const cv::Mat1b& gray, double reach_px, std::vector<cv::Point2f>* corners);

}  // namespace softbody
