#pragma once

#include <cstdint>

/// Values of a label image (mono8): what the camera sees at the pixel's centre. The truth has no unknown
/// pixels.
namespace softbody::labels {

constexpr std::uint8_t kUnknown = 0;
constexpr std::uint8_t kBackground = 1;  ///< neither of the others
constexpr std::uint8_t kOccluder = 2;    ///< a hand, a gripper or a tool
constexpr std::uint8_t kBody = 3;
constexpr const char* kNames[] = {"unknown", "background", "occluder", "body"};

}  // namespace softbody::labels
