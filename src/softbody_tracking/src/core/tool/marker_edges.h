#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Refines the corners of a dark quadrilateral on a bright background to sub-pixel precision. A curve is
/// fitted to the steepest places of the brightness profiles across each side. Neighbouring curves meet in the
/// corners.
/// @param corners accurate to about reach_px, clockwise in the image.
/// @param reach_px length of the profiles on both sides of an edge; less than the distance to the next inner
/// edge.
/// @return false, with unchanged corners, if a side shows no edge or a corner would move by more than twice
/// the reach.
bool refineQuadrilateral(const cv::Mat1b& gray, double reach_px, std::vector<cv::Point2f>* corners);

}  // namespace softbody
