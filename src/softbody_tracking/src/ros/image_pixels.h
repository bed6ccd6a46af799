#pragma once

#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace softbody {

/// Whether this machine's numbers begin with the highest byte.
bool isBigEndian();

/// The encoding by its usual name: drivers and scripts also write BGR8, or only the type of the pixels
/// (8UC3).
std::string usualEncoding(const std::string& encoding);

/// The pixels of an image in this machine's byte order, with the type of its encoding. They share the memory
/// of the message where its rows allow it, so the message must outlive them.
/// @param name of the image in a sentence, for example "colour".
/// @throw std::invalid_argument if size, encoding and number of bytes do not fit together.
cv::Mat pixelsOf(const sensor_msgs::Image& image, const char* name);

/// The pixels in another encoding. They may share the memory of the message.
/// @throw std::invalid_argument as pixelsOf(), or if this encoding has no such pixels.
cv::Mat pixelsAs(const sensor_msgs::Image& image, const std::string& encoding, const char* name);

}  // namespace softbody
