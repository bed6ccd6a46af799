#pragma once

#include <rosbag/bag.h>

#include <string>

namespace softbody {

/// A bag to read from. @throw std::invalid_argument with its name if it is no readable bag.
rosbag::Bag openBag(const std::string& path);

}  // namespace softbody
