#pragma once

#include <cstddef>
#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Every pixel near a blade is compared with every corner: with more of them a frame would take too long.
constexpr std::size_t kMostBladeCorners = 64;

/// A larger tool was probably given in millimetres.
constexpr double kLargestTool_m = 2.0;

/// @throw std::invalid_argument unless the count is 3 to kMostBladeCorners.
void requireBladeCorners(std::size_t count);

/// What is wrong with a blade, as the end of a sentence that begins with its name: it has no area, is not
/// planar (within 2 % of its length), or is larger than a tool. Empty: nothing.
/// @param corners #P by 3, three or more, finite [m].
std::string bladeFault(const Points& corners);

}  // namespace softbody
