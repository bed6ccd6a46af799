#pragma once

#include <opencv2/core.hpp>

namespace softbody {

/// Removes depths that sensors invent between two surfaces. With "near" meaning within ratio * z, a pixel
/// stays if
/// - at least two of its eight neighbours are near (a thin wire has them along itself, a stray pixel has
/// not), and
/// - in no direction it is a step between a nearer and a farther neighbour neither of which is near (a ramp
/// across an
///   edge; an object in front of the background has farther neighbours on both sides).
/// @param depth [m], 0: none. The result has memory of its own.
cv::Mat1f removeFlyingPixels(const cv::Mat1f& depth, double ratio);

}  // namespace softbody
