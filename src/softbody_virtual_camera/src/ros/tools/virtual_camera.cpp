#include "softbody_virtual_camera/tools/virtual_camera.h"

#include <fmt/format.h>
#include <ros/init.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "camera/camera_motion.h"
#include "catalog/make_scene.h"
#include "ros/node.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_sim/object/material.h"
#include "softbody_virtual_camera/ros/bag_writer.h"
#include "textures/body_paint.h"
#include "textures/painted_object.h"

namespace softbody::virtual_camera {
namespace {

struct Arguments {
  CameraSetup setup;
  std::string output, object;
  double duration_s = 0.0;
  bool noise = true;
  bool labels = false, small = false;
  std::vector<std::string> without;
};

void declareScene(CLI::App* app, Arguments* arguments) {
  CameraSetup& setup = arguments->setup;
  app->add_option("--output", arguments->output, "bag to write; default: none, a live node publishes");
  app->add_option("--scene", setup.scene, "motion of the body")
      ->check(CLI::IsMember(sceneNames()))
      ->capture_default_str();
  app->add_option("--camera-motion", setup.camera_motion,
                  "orbit: the camera moves around the body; the truth and /tf then have the frame world")
      ->check(CLI::IsMember(cameraMotionNames()))
      ->capture_default_str();
  app->add_option(
         "--texture", setup.texture,
         "texture of the body: rich; weak, like foam or cloth; plain: one colour; sponge: foam with pores")
      ->check(CLI::IsMember(textureNames()))
      ->capture_default_str();
  app->add_option("--body", setup.body,
                  "soft body at rest: OBJ (with the images of its materials), PLY, STL or OFF; default: "
                  "the scene's body")
      ->check(CLI::ExistingFile);
  app->add_option("--unit", setup.unit, "unit of the body's file")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->capture_default_str();
  app->add_option("--tool", setup.tool,
                  "tool YAML for the scenes with a cut; default: the shipped knife.yaml")
      ->check(CLI::ExistingFile);
  app->add_option(
      "--sheet", setup.sheet,
      "scans (walk, walk_hand, flip, turntable): YAML of the sheet with markers below the body, or "
      "none; default: the shipped sheet.yaml");
  app->add_flag("--jerks", setup.jerks, "scans: the camera is pushed aside at 0.3 m/s, five times");
  app->add_flag("--camera-tf", setup.camera_tf,
                "scans: the camera's pose is on /tf, as on an arm; the truth then has the frame world");
  app->add_option("--object", arguments->object,
                  "folder to write: the body as an object whose picture is its texture; an earlier one is "
                  "replaced");
  addAllowOutside(app, &setup.scope);
}

void addVector(CLI::App* app, const char* name, const char* text, Eigen::Vector3d* vector) {
  app->add_option_function<std::vector<double>>(
         name, [vector](const std::vector<double>& numbers) { *vector = Eigen::Vector3d(numbers.data()); },
         text)
      ->expected(3);
}

void declareImages(CLI::App* app, Arguments* arguments) {
  CameraSetup& setup = arguments->setup;
  const std::map<std::string, bool> on_off = {{"on", true}, {"off", false}};
  app->add_option("--seed", setup.seed, "seed of textures and noise")->capture_default_str();
  app->add_option("--noise", arguments->noise, "sensor noise: on or off")
      ->transform(CLI::CheckedTransformer(on_off));
  app->add_option("--without", arguments->without, "parts of the noise to switch off")
      ->check(CLI::IsMember(noiseParts()));
  app->add_flag("!--no-hands", setup.hands, "no hands and other things; the body moves as with them");
  app->add_flag("--labels", arguments->labels, "also write the true label of each pixel");
  app->add_flag("--small", arguments->small, "compress with bz2: half the size, but slow");
  app->add_option("--duration", arguments->duration_s, "length [s]; default: that of the scene")
      ->check(CLI::Range(0.001, 36000.0));
  app->add_option("--rate", setup.rate_hz, "frames per second [Hz]")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app->add_option("--width", setup.width, "image width [px]")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  app->add_option("--height", setup.height, "image height [px]")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
}

void declareElasticBody(CLI::App* app, Arguments* arguments) {
  CameraSetup& setup = arguments->setup;
  WrenchSensorOptions& sensor = setup.noise.wrench;
  app->add_option("--youngs-modulus", setup.youngs_modulus_pa,
                  "scenes with a solver: of the body [Pa]; default: that of the shipped object, or 20000")
      ->check(CLI::Range(kYoungsModulusRange.min, kYoungsModulusRange.max));
  app->add_option("--poisson", setup.poisson_ratio, "likewise: Poisson's ratio; default 0.2")
      ->check(CLI::Range(kPoissonRatioRange.min, kPoissonRatioRange.max));
  app->add_option(
         "--density", setup.density_kg_m3,
         "likewise: density [kg/m^3]; default: so that the body sags by a share of its length that the "
         "scene chooses")
      ->check(CLI::Range(kDensityRange.min, kDensityRange.max));
  app->add_option("--damping", setup.damping, "likewise: share of the velocity lost in 1/30 s; default 0.1")
      ->check(CLI::Range(kDampingRange.min, 0.99));
  app->add_option(
         "--wrench-noise", sensor.std_n,
         "standard deviation of each force of the force/torque sensors [N]; a torque has 0.05 m times it")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  addVector(app, "--wrench-bias", "constant error of the sensors' forces, x y z of the sensor [N]",
            &sensor.bias_n);
  addVector(app, "--wrench-drift", "error that grows with time, x y z of the sensor [N/s]",
            &sensor.drift_n_s);
}

void writeObject(const Actor& body, const std::string& folder) {
  if (!body.skin.pictures.empty())
    throw std::invalid_argument("--object: the body has a picture already; give its OBJ to prepare_model");
  writePaintedObject(body.rest, body.texture, folder);
}

void write(const Arguments& arguments) {
  std::vector<std::string> warnings;
  VirtualCamera camera = makeCamera(arguments.setup, &warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "virtual_camera: warning: {}\n", warning);
  if (!arguments.object.empty()) writeObject(camera.scene().actors.at(0), arguments.object);
  if (arguments.output.empty()) return;
  const double duration_s = arguments.duration_s > 0.0 ? arguments.duration_s : camera.scene().duration_s;
  const int frames = std::max(1, static_cast<int>(std::lround(duration_s * arguments.setup.rate_hz)));
  writeBag(&camera, {arguments.output, frames, arguments.setup.rate_hz, arguments.labels, arguments.small},
           [&](int done) {
             if (done % 30 == 0) fmt::print(stderr, "frame {} of {}\n", done, frames);
           });
  if (const auto& material = camera.scene().material)
    fmt::print(stderr, "material of the body:\n{}", materialText(*material));
  if (!camera.scene().robot.empty()) {
    const std::string urdf = arguments.output + ".urdf";
    replaceFile(urdf, urdfText(camera.scene().robot));
    fmt::print(stderr, "{}: the robot of the scene\n", urdf);
  }
  fmt::print(stderr, "{}: scene {}, {} frames\n", arguments.output, arguments.setup.scene, frames);
}

}  // namespace

int runVirtualCamera(int argc, char** argv) {
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  words.erase(words.begin());
  std::reverse(words.begin(), words.end());

  Arguments arguments;
  arguments.setup = shippedSetup();
  CLI::App app("A virtual RGB-D camera in front of a deforming body, with exact ground truth",
               "virtual_camera");
  declareScene(&app, &arguments);
  declareElasticBody(&app, &arguments);
  declareImages(&app, &arguments);
  addVersion(&app);
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (!arguments.noise) arguments.without = noiseParts();
    for (const std::string& part : arguments.without) switchOff(part, &arguments.setup.noise);
    if (arguments.output.empty() && arguments.object.empty()) return runNode(argc, argv, arguments.setup);
    removeStagedFilesOnSignal();
    write(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "virtual_camera: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace softbody::virtual_camera
