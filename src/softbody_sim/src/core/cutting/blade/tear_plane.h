#pragma once

#include <vector>

#include "cutting/blade/tear_marks.h"

namespace softbody {

/// The plane in which the zone tears: the most probable one that separates the sides of the marks. A logistic
/// regression with the zone's plane as its prior (Bishop 2006, 4.5), in which some of the marks are wrong
/// matches. Without marks it is the zone's plane.
RestPlane tearPlane(const TearZone& zone, const std::vector<TearMark>& marks);

}  // namespace softbody
