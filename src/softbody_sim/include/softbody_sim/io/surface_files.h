#pragma once

#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/files/obj_materials.h"
#include "softbody_common/geometry/types.h"
#include "softbody_common/images/vertex_colors.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// The triangle mesh of a file, in file units. Polygons are triangulated.
struct SurfaceFile {
  TriangleMesh mesh;               ///< vertices in file order, all of them finite
  Points texture_coordinates;      ///< empty, or 3 #F rows (u, v, 0), in the order of the triangles' corners
  std::vector<int> material = {};  ///< #F: index into `materials`; -1: none
  std::vector<std::string> materials = {};  ///< names (OBJ) or pictures (PLY)
  std::vector<FileReference> references =
      {};  ///< material files (OBJ), or the picture of each material (PLY)
  std::vector<float> seen =
      {};  ///< #V: the property `seen` of a scan's vertices (PLY), 1: was measured; else empty
};

/// The pictures of a surface.
struct SurfacePictures {
  std::vector<int> picture;        ///< empty, or #F: index into `files`; -1: none
  std::vector<std::string> files;  ///< existing files
};

/// Reads OBJ, OFF, PLY (ascii, binary) or STL (ascii, binary). The file's extension selects the format.
/// @param warnings gets a sentence for each kind of thing that was left out.
/// @throw std::invalid_argument with the file, the line or element, and the error.
SurfaceFile readSurfaceFile(const std::string& path, Warnings* warnings);

/// The pictures that a surface file names: map_Kd in the files of mtllib, or PLY's comment TextureFile. One
/// that is missing or outside of its scope gives a warning.
SurfacePictures surfacePictures(const SurfaceFile& file, FileScope scope, Warnings* warnings);

/// What an OBJ says beside its triangles. Each part may be empty.
struct ObjLook {
  Points texture_coordinates = {};  ///< 3 #F rows
  std::string material_file = {};   ///< named in mtllib
  VertexColors colors = {};         ///< #V
};

/// Writes an OBJ with 17 significant digits. @throw std::runtime_error if the file cannot be written.
void writeObj(const std::string& path, const TriangleMesh& mesh, const ObjLook& look = {});

}  // namespace softbody
