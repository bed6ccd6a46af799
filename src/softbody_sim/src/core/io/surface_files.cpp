#include "softbody_sim/io/surface_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include "io/obj_file.h"
#include "io/off_file.h"
#include "io/ply_file.h"
#include "io/stl_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

/// Programs that open other formats, and export one that is read here.
std::string converterOf(const std::string& extension) {
  static const std::vector<std::pair<std::set<std::string>, const char*>> kConverters{
      {{"3ds", "abc", "blend", "dae", "fbx", "glb", "gltf", "usd", "usdz", "wrl", "x3d"},
       "open it in Blender and export it as OBJ"},
      {{"3mf", "amf", "ctm", "pcd", "pts", "u3d", "vrml", "xyz"}, "open it in MeshLab and export it as PLY"},
      {{"brep", "iges", "igs", "step", "stp"}, "open it in FreeCAD, make a mesh of it, and export it as STL"},
      {{"e", "exo", "inp", "mesh", "vtk", "vtp", "xdmf"}, "convert it: meshio convert FILE mesh.ply"},
      {{"ele", "msh", "node", "tet", "veg", "vtu"}, "it holds tets: name it as tet_mesh in an object YAML"}};
  for (const auto& [extensions, advice] : kConverters) {
    if (extensions.count(extension) > 0) return advice;
  }
  return "convert it with Blender or MeshLab";
}

SurfaceFile readSurfaceByExtension(const std::string& path, Warnings* warnings) {
  const std::string extension = extensionOf(path);
  if (extension == "obj") return readObj(path, warnings);
  if (extension == "off") return readOff(path, warnings);
  if (extension == "ply") return readPly(path, warnings);
  if (extension == "stl") return readStl(path, warnings);
  throw std::invalid_argument(
      fmt::format("{}: '.{}' is not a surface mesh format; supported: .obj, .off, .ply, .stl; {}", path,
                  extension, converterOf(extension)));
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

SurfacePictures surfacePictures(const SurfaceFile& file, FileScope scope, Warnings* warnings) {
  if (file.references.empty()) return {};
  const std::string folder = file.references.front().file.parent_path().string();
  const std::string within = scope == FileScope::kAnywhere ? "" : folder.empty() ? "." : folder;
  const MaterialPictures known = picturesOf(file.references, file.materials, within, warnings);
  SurfacePictures pictures{{}, known.files};
  for (const int material : file.material)
    pictures.picture.push_back(material < 0 ? known.otherwise
                                            : known.index[static_cast<std::size_t>(material)]);
  return pictures;
}

void writeObj(const std::string& path, const TriangleMesh& mesh, const ObjLook& look) {
  std::ostringstream stream;
  if (!look.material_file.empty()) stream << fmt::format("mtllib {}\nusemtl body\n", look.material_file);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    stream << fmt::format("v {:.17g} {:.17g} {:.17g}", mesh.vertices(v, 0), mesh.vertices(v, 1),
                          mesh.vertices(v, 2));
    if (!look.colors.empty()) {
      for (const double byte : look.colors[static_cast<std::size_t>(v)])
        stream << fmt::format(" {:.4g}", byte / 255.0);
    }
    stream << '\n';
  }
  const Points& texture = look.texture_coordinates;
  for (Eigen::Index t = 0; t < texture.rows(); ++t)
    stream << fmt::format("vt {:.9g} {:.9g}\n", texture(t, 0), texture(t, 1));
  const bool textured = texture.rows() > 0;
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
