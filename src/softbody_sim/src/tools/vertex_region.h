#pragma once

#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// @throw std::invalid_argument with what cannot be read of a text as verticesWhere takes it.
void requireRegion(const std::string& region);

/// Vertices that meet every one of the conditions in a text such as "x<0.01" or "x>=0.9 & z>0.05" [m], or
/// "all".
/// @throw std::invalid_argument with the condition that cannot be read, or if no vertex meets all.
std::vector<int> verticesWhere(const std::string& region, const Points& vertices);

}  // namespace softbody
