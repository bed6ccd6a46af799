#pragma once

#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Checks the syntax of a region. @throw std::invalid_argument with the condition that cannot be read.
void requireRegion(const std::string& region);

/// Vertices in a region: "all", or conditions that all hold, such as "x<0.01" or "x>=0.9 & z>0.05" [m].
/// @throw std::invalid_argument with the condition that cannot be read, or if the region has no vertex.
std::vector<int> verticesWhere(const std::string& region, const Points& vertices);

}  // namespace softbody
