#pragma once

#include <string>

#include "tool/aruco.h"

namespace softbody {

/// A dictionary whose markers stand upright as they are published: ArUco's as OpenCV draws them, AprilTags as
/// in the images of the AprilTag project. OpenCV before version 5 has AprilTags upside down; they are turned.
/// @param name as markersInDictionary.
/// @throw std::invalid_argument with the known names if it is neither a name nor a file.
/// @throw std::runtime_error if OpenCV's markers are not the published ones in any orientation.
aruco::Dictionary uprightDictionary(const std::string& name);

/// Detects a drawn marker 0 of a predefined dictionary and compares its corners with where they were drawn.
/// A file is not checked: its marker 0 may look the same in several orientations.
/// @throw std::runtime_error if this OpenCV gives the corners in another order.
void requireCornerOrder(const std::string& name, const aruco::Dictionary& dictionary,
                        const aruco::Detector& detector);

}  // namespace softbody
