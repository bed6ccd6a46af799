#include "softbody_virtual_camera/camera/camera_setup.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>

#include "camera/camera_motion.h"
#include "catalog/make_scene.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_virtual_camera/bodies/body.h"

namespace softbody::virtual_camera {
namespace {

std::map<std::string, bool*> switches(NoiseOptions* noise) {
  return {{"exposure", &noise->exposure.enabled},
          {"blur", &noise->blur.enabled},
          {"color", &noise->color.enabled},
          {"disparity", &noise->depth.disparity_noise},
          {"quantization", &noise->depth.quantization},
          {"edges", &noise->depth.edge_dropouts},
          {"holes", &noise->depth.holes},
          {"wrench", &noise->wrench.noise}};
}

/// The shape and the material of the user's body, or of the shipped one.
Body fileBodyOf(const CameraSetup& setup, Warnings* warnings) {
  if (!setup.body.empty()) return readBody(setup.body, metresPer(setup.unit), warnings, setup.scope);
  const std::string shipped = setup.config_folder + "/" + objectOf(setup.scene);
  Body body = readBody(shipped + ".obj", 1.0, warnings, setup.scope);
  const Material material = loadObjectDescription(shipped + ".yaml").material;
  body.elasticity = {material.youngs_modulus_pa, material.poisson_ratio, std::nullopt, material.damping};
  return body;
}

Body bodyOf(const CameraSetup& setup, Warnings* warnings) {
  Body body = fileBodyOf(setup, warnings);
  Elasticity& elasticity = body.elasticity;
  elasticity.youngs_modulus_pa = setup.youngs_modulus_pa.value_or(elasticity.youngs_modulus_pa);
  elasticity.poisson_ratio = setup.poisson_ratio.value_or(elasticity.poisson_ratio);
  elasticity.damping = setup.damping.value_or(elasticity.damping);
  if (setup.density_kg_m3) elasticity.density_kg_m3 = setup.density_kg_m3;
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
  if (sheet != "none") options.sheet = loadToolWithMarkers(sheet, setup.scope);
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
  const bool given = setup.youngs_modulus_pa || setup.poisson_ratio || setup.density_kg_m3 || setup.damping;
  if (given && !scene.material && warnings)
    warnings->push_back(fmt::format(
        "the scene '{}' has no elastic body; youngs_modulus, poisson_ratio, density and damping do nothing",
        setup.scene));
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
