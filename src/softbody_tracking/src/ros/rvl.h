#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace softbody {

/// 16-bit depth of the codec RVL (Wilson 2017, "Fast lossless depth image compression"), as
/// compressed_depth_image_transport sends it: columns, rows, then runs of zeros and differences in groups of
/// 4 bits.
/// @throw std::invalid_argument if the data is damaged, or stands for too many pixels.
cv::Mat1w decodeRvl(const std::uint8_t* data, std::size_t size);

}  // namespace softbody
