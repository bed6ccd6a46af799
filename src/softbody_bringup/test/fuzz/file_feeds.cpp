#include "fuzz/feeds.h"
#include "fuzz/scratch_files.h"
#include "softbody_recordings/image_folder/image_folder.h"
#include "softbody_recordings/ros/graph_config.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/object/visual_mesh.h"
#include "softbody_tracking/tool/tool_description.h"

namespace softbody::fuzz {

void giveSurface(const char* extension, std::string_view bytes) {
  ObjectDescription description;
  description.visual_mesh = fileWith(std::string("surface.") + extension, bytes);
  expectReadOrRefused<std::invalid_argument>(description.visual_mesh, [&] {
    Warnings warnings;
    loadVisualMesh(description, &warnings);
  });
}

void giveTets(const char* extension, std::string_view bytes) {
  const std::string path = fileWith(std::string("tets.") + extension, bytes);
  expectReadOrRefused<std::invalid_argument>(path, [&] {
    Warnings warnings;
    readTetFile(path, &warnings);
  });
}

/// The two files of TetGen are separated by the first zero byte.
void giveTetGen(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  const std::string path = fileWith("tets.node", bytes.substr(0, end));
  fileWith("tets.ele", bytes.substr(std::min(end + 1, bytes.size())));
  expectReadOrRefused<std::invalid_argument>(path, [&] {
    Warnings warnings;
    readTetFile(path, &warnings);
  });
}

void giveObjectYaml(std::string_view bytes) {
  fileWith("visual.obj", "");
  const std::string path = fileWith("object.yaml", bytes);
  expectReadOrRefused<std::invalid_argument>(path, [&] { loadObjectDescription(path); });
}

void giveToolYaml(std::string_view bytes) {
  const std::string path = fileWith("tool.yaml", bytes);
  expectReadOrRefused<std::invalid_argument>(path, [&] { loadToolDescription(path); });
}

void giveCameraYaml(std::string_view bytes) {
  const std::string path = fileWith("camera.yaml", bytes);
  expectReadOrRefused<std::runtime_error>(path, [&] { readFolderCamera(path); });
}

void giveParameters(std::string_view bytes) {
  const std::string path = fileWith("parameters.yaml", bytes);
  std::vector<std::string> warnings;
  try {
    readGraphConfig(path, &warnings);
  } catch (const std::invalid_argument&) {
  } catch (const std::exception& other) {
    throw std::logic_error(std::string("not a refusal: ") + other.what());
  }
}

}  // namespace softbody::fuzz
