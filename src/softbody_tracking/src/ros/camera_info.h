#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>

#include "softbody_tracking/camera/camera_images.h"

/// Reads sensor_msgs/CameraInfo.
namespace softbody {

/// The camera of an image: the CameraInfo without binning and region of interest (REP 104), which tell what
/// part of the sensor the image shows. An image of the sensor's whole size was not binned. A CameraInfo of
/// size 0 has the size of the image.
/// @param name of the image in a sentence, for example "colour".
/// @throw std::invalid_argument if the image has another size than the CameraInfo says.
sensor_msgs::CameraInfo infoOfImage(const sensor_msgs::CameraInfo& info, std::uint32_t width,
                                    std::uint32_t height, const char* name);

/// The lens. Zeros at the end of D mean nothing, so any number of them is accepted.
/// @throw std::invalid_argument if the model is unknown, or D has too many coefficients for it.
Distortion distortionFromMessage(const sensor_msgs::CameraInfo& info);

}  // namespace softbody
