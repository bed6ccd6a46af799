#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {

/// The user's choices, from the command line or from parameters.
struct CameraSetup {
  std::string scene = "bend";
  std::string camera_motion = "none";
  std::string texture = "rich";             ///< of the body: rich, weak or plain
  std::string body;                         ///< OBJ, PLY, STL or OFF; empty: the scene's body
  std::string unit = "m";                   ///< unit of the body's file: m, cm, mm or inch
  std::string tool;                         ///< tool YAML; empty: knife.yaml
  std::string sheet;                        ///< of the scans: its YAML, or none; empty: sheet.yaml
  bool jerks = false, camera_tf = false;    ///< of the scans; see ScanOptions
  FileScope scope = FileScope::kOwnFolder;  ///< of the files that the body's OBJ names
  std::string config_folder;  ///< folder of the shipped objects, of knife.yaml and of sheet.yaml
  std::uint64_t seed = 1;
  int width = 640, height = 480;  ///< [px]
  double rate_hz = 30.0;
  bool hands = true;  ///< if false, hands and fingers are hidden; the body moves in the same way
  NoiseOptions noise;
  /// Of the body in scenes with a solver; none: the shipped object's, or the default of Elasticity.
  std::optional<double> youngs_modulus_pa, poisson_ratio, density_kg_m3, damping;
};

/// @param warnings if not null, gets a sentence about each ignored part of the body's file.
/// @throw std::invalid_argument if the scene, the texture or the camera motion is unknown, or if the body
/// cannot be read or does not fit the scene.
VirtualCamera makeCamera(const CameraSetup& setup, std::vector<std::string>* warnings = nullptr);

/// The parts of the noise: exposure, blur, color, disparity, quantization, edges, holes, wrench.
std::vector<std::string> noiseParts();
/// Switches one part off. @throw std::invalid_argument with the known names if the part is unknown.
void switchOff(const std::string& noise_part, NoiseOptions* noise);

}  // namespace softbody::virtual_camera
