#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

namespace softbody {

/// The image of the transports `compressed` (JPEG or PNG) and `compressedDepth` (PNG or RVL; 32FC1 as 16 bits
/// of inverse depth), with the same header. The data decide about the format, not its name. Debian has no
/// plugins of image_transport for them.
/// @throw std::invalid_argument if the format is unknown or the data is damaged.
sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& image);

}  // namespace softbody
