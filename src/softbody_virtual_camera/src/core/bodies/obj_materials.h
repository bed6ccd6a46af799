#pragma once

#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"

namespace softbody::virtual_camera {

/// The image of each triangle of an OBJ file.
struct ObjMaterials {
  std::vector<int> image;          ///< per triangle (polygons fanned), index into `files`; -1: none
  std::vector<std::string> files;  ///< images of map_Kd, with absolute paths or relative to the MTL file
};

/// @param scope where the files may be that the OBJ and its MTL name.
/// @throw std::invalid_argument with file, line and error.
ObjMaterials readObjMaterials(const std::string& obj_path, FileScope scope);

}  // namespace softbody::virtual_camera
