#include "softbody_virtual_camera/camera/camera_setup.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "softbody_sim/object/object_description.h"
#include "softbody_virtual_camera/bodies/body.h"
#include "softbody_virtual_camera/camera/camera_motion.h"

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

}  // namespace

VirtualCamera makeCamera(const CameraSetup& setup, std::vector<std::string>* warnings) {
  const std::string shipped = setup.config_folder + "/" + objectOf(setup.scene) + ".obj";
  const std::string& file = setup.body.empty() ? shipped : setup.body;
  Warnings ignored;
  Body body = readBody(file, setup.body.empty() ? 1.0 : metresPer(setup.unit), warnings ? warnings : &ignored,
                       setup.scope);
  const Material material =
      loadObjectDescription(setup.config_folder + "/" + objectOf(setup.scene) + ".yaml").material;
  body.elasticity = {material.youngs_modulus_pa, material.poisson_ratio};
  const std::string tool = setup.tool.empty() ? setup.config_folder + "/knife.yaml" : setup.tool;
  const Scene scene = makeScene(setup.scene, body, setup.seed, tool, setup.texture);
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
