#include "softbody_sim/io/surface_files.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "io/obj_file.h"
#include "io/off_file.h"
#include "io/ply_file.h"
#include "io/stl_file.h"
#include "io/text_reader.h"
#include "softbody_common/files/staged_output.h"

namespace softbody {
namespace {

SurfaceFile readSurfaceByExtension(const std::string& path, Warnings* warnings) {
  const std::string extension = extensionOf(path);
  if (extension == "obj") return readObj(path, warnings);
  if (extension == "off") return readOff(path);
  if (extension == "ply") return readPly(path);
  if (extension == "stl") return readStl(path);
  throw std::invalid_argument(fmt::format(
      "{}: '.{}' is not a surface mesh format; supported: .obj, .off, .ply, .stl", path, extension));
}

}  // namespace

SurfaceFile readSurfaceFile(const std::string& path, Warnings* warnings) {
  SurfaceFile file = readSurfaceByExtension(path, warnings);
  if (file.mesh.triangles.rows() == 0) {
    throw std::invalid_argument(fmt::format("{}: {} vertices and no faces; a surface mesh is needed", path,
                                            file.mesh.vertices.rows()));
  }
  return file;
}

void writeObj(const std::string& path, const TriangleMesh& mesh, const Points& texture_coordinates) {
  std::ostringstream stream;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    stream << fmt::format("v {:.17g} {:.17g} {:.17g}\n", mesh.vertices(v, 0), mesh.vertices(v, 1),
                          mesh.vertices(v, 2));
  }
  for (Eigen::Index t = 0; t < texture_coordinates.rows(); ++t) {
    stream << fmt::format("vt {:.9g} {:.9g}\n", texture_coordinates(t, 0), texture_coordinates(t, 1));
  }
  const bool textured = texture_coordinates.rows() > 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    stream << 'f';
    for (int k = 0; k < 3; ++k) {
      stream << fmt::format(" {}", mesh.triangles(f, k) + 1);
      if (textured) stream << fmt::format("/{}", 3 * f + k + 1);
    }
    stream << '\n';
  }
  writeBytes(path, stream.str());
}

}  // namespace softbody
