#pragma once

#include <string>
#include <vector>

#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {

/// What a user chooses, on the command line or as parameters.
struct CameraSetup {
  std::string scene = "bend";
  std::string camera_motion = "none";
  std::string body;           ///< OBJ, PLY, STL or OFF; empty: the scene's own object
  std::string unit = "m";     ///< of the body's file: m, cm, mm or inch
  std::string config_folder;  ///< of the shipped objects and of knife.yaml
  std::uint64_t seed = 1;
  int width = 640, height = 480;  ///< [px]
  double rate_hz = 30.0;
  bool hands = true;  ///< false: neither hand nor finger is seen, though the body moves as if they were there
  NoiseOptions noise;
};

/// @param warnings gets what was ignored in the body's file, if given.
/// @throw std::invalid_argument if the scene or the camera's motion is unknown, or the body cannot be read or
/// does not fit it.
VirtualCamera makeCamera(const CameraSetup& setup, std::vector<std::string>* warnings = nullptr);

/// Names of the parts of the noise: exposure, blur, color, disparity, quantization, edges, holes.
std::vector<std::string> noiseParts();
/// @throw std::invalid_argument with the known names if there is no such part.
void switchOff(const std::string& noise_part, NoiseOptions* noise);

}  // namespace softbody::virtual_camera
