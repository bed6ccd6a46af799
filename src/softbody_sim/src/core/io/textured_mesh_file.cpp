#include "softbody_sim/io/textured_mesh_file.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "softbody_common/files/staged_output.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody {

void writeTexturedObj(const std::filesystem::path& obj, const TriangleMesh& mesh,
                      const Points& texture_coordinates, const cv::Mat3b& picture) {
  const std::filesystem::path materials = std::filesystem::path(obj).replace_extension(".mtl"),
                              png = std::filesystem::path(obj).replace_extension(".png");
  std::vector<std::uint8_t> bytes;
  if (picture.empty() || !cv::imencode(".png", picture, bytes))
    throw std::runtime_error(fmt::format("{}: the picture cannot be written", png.string()));
  writeObj(obj.string(), mesh, {texture_coordinates, materials.filename().string()});
  writeBytes(materials, fmt::format("newmtl body\nKd 1 1 1\nmap_Kd {}\n", png.filename().string()));
  writeBytes(png, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace softbody
