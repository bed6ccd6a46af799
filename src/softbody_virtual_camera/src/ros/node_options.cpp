#include "softbody_virtual_camera/ros/node_options.h"

#include "camera/camera_motion.h"
#include "catalog/make_scene.h"
#include "textures/body_paint.h"

namespace softbody::virtual_camera {
namespace {

constexpr char kGroup[] = "virtual_camera";

/// What else a scene can be made of is given on the command line.
ParameterTable<CameraSetup> setupTable() {
  ParameterTable<CameraSetup> table;
  table.group(kGroup);
  table.choice("scene", &CameraSetup::scene, sceneNames(), "what happens").allowed = "see above";
  table.choice("camera_motion", &CameraSetup::camera_motion, cameraMotionNames(),
               "orbit: the camera moves around the body by 25 degrees to both sides, and 5 cm nearer and "
               "farther, at up to 0.3 m/s");
  table.choice(
      "texture", &CameraSetup::texture, textureNames(),
      "of the body. rich: many colours; weak: the same pattern with a contrast of 4 %, like foam or "
      "cloth; plain: one colour, also for a mesh with pictures; sponge: yellow foam with dark pores");
  table
      .text("body", &CameraSetup::body,
            "your own mesh [m]: OBJ or PLY with pictures, STL or OFF; longest side 50 mm to 2 m")
      .initial = "the scene's";
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
