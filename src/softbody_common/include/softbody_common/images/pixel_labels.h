#pragma once

#include <cstdint>

/// Values of a label image (8UC1): what the camera sees at the pixel's centre. The truth has no unknown
/// pixels.
namespace softbody::labels {

constexpr std::uint8_t kBackground = 0;  ///< neither of the others
constexpr std::uint8_t kBody = 1;
constexpr std::uint8_t kOccluder = 2;  ///< a hand, a gripper or a tool
constexpr std::uint8_t kUnknown = 3;
/// The values by name, without kUnknown.
constexpr const char* kNames[] = {"background", "body", "occluder"};

}  // namespace softbody::labels
