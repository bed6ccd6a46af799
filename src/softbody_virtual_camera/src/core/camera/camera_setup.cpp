#include "softbody_virtual_camera/camera/camera_setup.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "softbody_sim/object/object_description.h"
#include "softbody_virtual_camera/bodies/body.h"
#include "softbody_virtual_camera/camera/camera_motion.h"
#include "softbody_virtual_camera/catalog/make_scene.h"

namespace softbody::virtual_camera {
namespace {

std::map<std::string, bool*> switches(NoiseOptions* noise) {
  return {{"exposure", &noise->exposure.enabled},
          {"blur", &noise->blur.enabled},
          {"color", &noise->color.enabled},
          {"disparity", &noise->depth.disparity_noise},
          {"quantization", &noise->depth.quantization},
          {"edges", &noise->depth.edge_dropouts},
          {"holes", &noise->depth.holes}};
}

/// The user's body, or the shipped one with its material.
Body bodyOf(const CameraSetup& setup, Warnings* warnings) {
  if (!setup.body.empty()) return readBody(setup.body, metresPer(setup.unit), warnings, setup.scope);
  const std::string shipped = setup.config_folder + "/" + objectOf(setup.scene);
  Body body = readBody(shipped + ".obj", 1.0, warnings, setup.scope);
  const Material material = loadObjectDescription(shipped + ".yaml").material;
  body.elasticity = {material.youngs_modulus_pa, material.poisson_ratio};
  return body;
}

ScanOptions scanOptions(const CameraSetup& setup) {
  if (!isScan(setup.scene)) {
    if (setup.jerks || setup.camera_tf || !setup.sheet.empty())
      throw std::invalid_argument(
          fmt::format("sheet, jerks and camera_tf are for the scenes {}, not for '{}'",
                      fmt::join(scanNames(), ", "), setup.scene));
    return {};
  }
  if (setup.camera_motion != "none")
    throw std::invalid_argument(fmt::format(
        "camera motion '{}': the scene '{}' moves the camera itself; camera_tf gives its pose on tf",
        setup.camera_motion, setup.scene));
  ScanOptions options{std::nullopt, setup.jerks, setup.camera_tf};
  const std::string sheet = setup.sheet.empty() ? setup.config_folder + "/sheet.yaml" : setup.sheet;
  if (sheet != "none") options.sheet = loadToolDescription(sheet, setup.scope);
  return options;
}

}  // namespace

VirtualCamera makeCamera(const CameraSetup& setup, std::vector<std::string>* warnings) {
  Warnings ignored;
  const Body body = bodyOf(setup, warnings ? warnings : &ignored);
  const std::string tool = setup.tool.empty() ? setup.config_folder + "/knife.yaml" : setup.tool;
  std::optional<Body> second;
  if (const std::string object = secondObjectOf(setup.scene); !object.empty())
    second = readBody(setup.config_folder + "/" + object + ".obj", 1.0, warnings ? warnings : &ignored);
  const Scene scene =
      makeScene(setup.scene, body, setup.seed, tool, setup.texture, second, scanOptions(setup));
  const Scene shown = setup.hands ? scene : withoutHands(scene);
  return VirtualCamera(withCameraMotion(setup.camera_motion, shown), d435(setup.width, setup.height),
                       setup.noise, setup.seed);
}

std::vector<std::string> noiseParts() {
  NoiseOptions any;
  std::vector<std::string> names;
  for (const auto& [name, value] : switches(&any)) names.push_back(name);
  return names;
}

void switchOff(const std::string& noise_part, NoiseOptions* noise) {
  const auto parts = switches(noise);
  const auto found = parts.find(noise_part);
  if (found == parts.end()) {
    throw std::invalid_argument(
        fmt::format("the noise has no part '{}'; known: {}", noise_part, fmt::join(noiseParts(), ", ")));
  }
  *found->second = false;
}

}  // namespace softbody::virtual_camera
