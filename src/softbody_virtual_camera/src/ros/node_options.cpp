#include "softbody_virtual_camera/ros/node_options.h"

#include "camera/camera_motion.h"
#include "catalog/make_scene.h"
#include "softbody_sim/object/material.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr char kGroup[] = "virtual_camera";

void addScene(ParameterTable<CameraSetup>* table) {
  table->choice("scene", &CameraSetup::scene, sceneNames(), "what happens").allowed = "see above";
  table->choice("camera_motion", &CameraSetup::camera_motion, cameraMotionNames(),
                "orbit: the camera moves around the body by 25 degrees to both sides, and 5 cm nearer and "
                "farther, at up to 0.3 m/s");
  table->choice(
      "texture", &CameraSetup::texture, textureNames(),
      "of the body. rich: many colours; weak: the same pattern with a contrast of 4 %, like foam or "
      "cloth; plain: one colour, also for a mesh with pictures; sponge: yellow foam with dark pores");
  table
      ->text("body", &CameraSetup::body,
             "your own mesh: OBJ or PLY with pictures, STL or OFF; longest side 50 mm to 2 m")
      .initial = "the scene's";
  table->choice("unit", &CameraSetup::unit, {"m", "cm", "mm", "inch"}, "of the mesh's file");
  table
      ->text(
          "tool", &CameraSetup::tool,
          "tool YAML for the scenes with a cut. In `config/board.yaml` the board with the marker is itself "
          "the blade; scene `cut` turns it, so that its marker is seen")
      .initial = "`config/knife.yaml`";
  table->text("sheet", &CameraSetup::sheet, "of a scan: YAML of the sheet below the body, or none").initial =
      "`config/sheet.yaml`";
  table->flag("jerks", &CameraSetup::jerks, "of a scan: the camera is pushed aside");
  table->flag("camera_tf", &CameraSetup::camera_tf, "of a scan: the camera's pose is on /tf");
}

void addMaterial(ParameterTable<CameraSetup>* table) {
  const auto add = [table](const char* name, std::optional<double> CameraSetup::*member,
                           const MaterialRange& range, const char* unit, const char* initial,
                           const char* meaning) {
    table->number(name, member, {range.min, range.max}, unit, initial, meaning);
  };
  add("youngs_modulus", &CameraSetup::youngs_modulus_pa, kYoungsModulusRange, "Pa", "the object's",
      "true material of an [elastic body](#an-elastic-body-as-the-truth)");
  add("poisson_ratio", &CameraSetup::poisson_ratio, kPoissonRatioRange, "", "the object's", "likewise");
  add("density", &CameraSetup::density_kg_m3, kDensityRange, "kg/m³", "the scene's", "likewise");
  add("damping", &CameraSetup::damping, {kDampingRange.min, 0.99}, "", "the object's",
      "likewise; share of the velocity that is lost in 1/30 s");
}

ParameterTable<CameraSetup> setupTable() {
  ParameterTable<CameraSetup> table;
  table.group(kGroup);
  addScene(&table);
  addMaterial(&table);
  table.seed("seed", &CameraSetup::seed, "random seed of texture and noise");
  table.number("rate", &CameraSetup::rate_hz, {0.1, 1000.0}, "Hz", "frame rate");
  table.number("width", &CameraSetup::width, {16, 4096}, "px", "of the images");
  table.number("height", &CameraSetup::height, {16, 4096}, "px", "of the images");
  return table;
}

ParameterTable<NodeOptions> makeNodeTable() {
  ParameterTable<NodeOptions> table;
  table.group(kGroup);
  table.part(&NodeOptions::setup, setupTable());
  table.flag("noise", &NodeOptions::noise, "sensor noise");
  table.number("hold", &NodeOptions::hold_s, {0.0, 3600.0}, "s", "time at rest before the scene begins");
  table.flag("loop", &NodeOptions::loop, "repeat the scene");
  table.flag("publish_camera_tf", &NodeOptions::publish_camera_tf,
             "publish the transform from `camera_link` to the optical frame");
  return table;
}

}  // namespace

const ParameterTable<NodeOptions>& nodeParameters() {
  static const ParameterTable<NodeOptions> table = makeNodeTable();
  return table;
}

}  // namespace softbody::virtual_camera
