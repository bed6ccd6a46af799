#pragma once

#include <rosbag/bag.h>

#include <string>

namespace softbody {

/// Opens a bag for reading. @throw std::invalid_argument with the path if it is not a readable bag.
rosbag::Bag openBag(const std::string& path);

}  // namespace softbody
