#include "softbody_recordings/tools/import_images.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "ros/bags/camera_bag.h"
#include "softbody_common/ros/camera_messages.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/image_folder/image_folder.h"

namespace softbody {
namespace {

sensor_msgs::CameraInfo cameraInfo(const FolderCamera& camera) {
  sensor_msgs::CameraInfo info = toMessage(camera.camera);
  if (!camera.distortion.empty()) {
    info.distortion_model = camera.distortion_model;
    info.D = camera.distortion;
  }
  return info;
}

/// Both streams in the order of their stamps.
void writeImages(const ImageFolder& folder, CameraBag* bag) {
  const std::size_t total = folder.color.size() + folder.depth.size();
  bag->writeOpticalFrame(std::min(folder.color.front().stamp, folder.depth.front().stamp));
  for (std::size_t c = 0, d = 0; c + d < total;) {
    const bool color_next = d == folder.depth.size() ||
                            (c < folder.color.size() && folder.color[c].stamp <= folder.depth[d].stamp);
    if (color_next) {
      bag->writeColor(folder.color[c].stamp, readColor(folder.color[c].path, folder.camera.camera));
      ++c;
    } else {
      bag->writeDepth(folder.depth[d].stamp, readDepth(folder.depth[d].path, folder.camera));
      ++d;
    }
    if ((c + d) % 100 == 0 || c + d == total) fmt::print(stderr, "{} of {} images\n", c + d, total);
  }
}

}  // namespace

int runImportImages(int argc, char** argv) {
  std::string directory, output, camera;
  double rate_hz = 30.0;
  FileScope scope = FileScope::kOwnFolder;
  CLI::App app(
      "Makes a bag with the camera's topics from a folder with color/, depth/ and camera.yaml, or from a TUM "
      "RGB-D "
      "folder");
  app.add_option("DIR", directory, "folder of images")->required();
  app.add_option("--output", output, "bag to write")->required();
  app.add_option("--rate", rate_hz, "file number k gets the stamp start + k / rate [Hz]")
      ->check(CLI::Range(0.001, 1000.0));
  app.add_option("--camera", camera, "camera file instead of DIR/camera.yaml");
  addAllowOutside(&app, &scope);
  return runTool(&app, argc, argv, [&] {
    const ImageFolder folder = readImageFolder(directory, camera, rate_hz, scope);
    for (const std::string& warning : folder.warnings) fmt::print(stderr, "warning: {}\n", warning);
    CameraBag bag(output, cameraInfo(folder.camera));
    writeImages(folder, &bag);
    bag.finish();
    fmt::print("{}: {} colour and {} depth images\n", output, folder.color.size(), folder.depth.size());
    return 0;
  });
}

}  // namespace softbody
