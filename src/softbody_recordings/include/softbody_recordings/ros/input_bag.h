#pragma once

#include <rosbag/bag.h>
#include <rosbag/exceptions.h>

#include <stdexcept>
#include <string>

namespace softbody {

/// Opens a bag for reading. @throw std::invalid_argument with the path if it is not a readable bag.
rosbag::Bag openBag(const std::string& path);

/// What to throw if reading an open bag fails: the library names neither the file nor a remedy.
std::runtime_error damagedBag(const std::string& path, const rosbag::BagException& error);

}  // namespace softbody
