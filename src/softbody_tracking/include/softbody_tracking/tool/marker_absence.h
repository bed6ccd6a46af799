#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

/// Why the tool's markers are not detected in an image, as a sentence without a full stop: they are printed
/// inverted, mirrored, without a white margin or too small, they have no contrast, or there are markers of
/// another id or dictionary. Empty: nothing in the image looks like a marker. It takes some tenths of a
/// second, so call it once in a while.
std::string whyMarkersAreMissed(const ToolDescription& tool, const cv::Mat3b& color);

}  // namespace softbody
