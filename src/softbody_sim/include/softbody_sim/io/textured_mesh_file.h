#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Writes a mesh with its picture: NAME.obj, NAME.mtl and NAME.png beside each other.
/// @param obj path of NAME.obj. @param texture_coordinates 3 #F rows (u, v, 0), in the order of the
/// triangles' corners; (0, 0) is the picture's lower left corner. @param picture BGR.
/// @throw std::runtime_error if a file cannot be written.
void writeTexturedObj(const std::filesystem::path& obj, const TriangleMesh& mesh,
                      const Points& texture_coordinates, const cv::Mat3b& picture);

}  // namespace softbody
