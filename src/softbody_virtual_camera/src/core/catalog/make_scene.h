#pragma once

#include "scanned/scan_scene.h"
#include "softbody_virtual_camera/scenes/scene.h"

/// All scenes by name.
namespace softbody::virtual_camera {

/// The names of all scenes.
std::vector<std::string> sceneNames();

/// Whether a scene is a recording of a body at rest, as of scanNames().
bool isScan(const std::string& scene);

/// The shipped object of a scene: "doll" if the name starts with "doll_", otherwise "sponge".
std::string objectOf(const std::string& scene);

/// The shipped object of the second body: the other one, in a scene with two bodies; otherwise empty.
std::string secondObjectOf(const std::string& scene);

/// @param body from 50 mm to 2 m long. The scene is scaled and turned to fit the body's longest axis.
/// @param seed of the textures. @param tool_file YAML, only for scenes with a tool. @param texture of the
/// bodies. @param second for scenes with two bodies; gets the length of the body. @param scan only for scans.
/// @throw std::invalid_argument with the known names if the scene or the texture is unknown, or if the body
/// does not fit.
Scene makeScene(const std::string& name, const Body& body, std::uint64_t seed,
                const std::string& tool_file = "", const std::string& texture = "rich",
                const std::optional<Body>& second = std::nullopt, const ScanOptions& scan = {});

}  // namespace softbody::virtual_camera
