#pragma once

#include <string>
#include <vector>

namespace softbody::virtual_camera {

/// Which image each triangle of an OBJ file shows.
struct ObjMaterials {
  std::vector<int> image;          ///< per triangle (polygons fanned), index into `files`; -1: none
  std::vector<std::string> files;  ///< that the materials name by map_Kd, beside the MTL file or absolute
};

/// @throw std::invalid_argument with file, line and what is wrong or missing.
ObjMaterials readObjMaterials(const std::string& obj_path);

}  // namespace softbody::virtual_camera
