#pragma once

#include <functional>
#include <string>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The folder of a ROS package; empty: there is no such package.
using PackageFolder = std::function<std::string(const std::string& package)>;

/// The path of a file that a URDF names: package://NAME/..., file://..., or a path.
/// @param folder where a relative path starts. @throw std::invalid_argument if the package is unknown, or the
/// scheme is another one.
std::string robotFilePath(const std::string& name, const PackageFolder& packages, const std::string& folder);

/// The triangles of a mesh file in metres: STL, OBJ, PLY, OFF, or COLLADA (DAE) with its unit. As in rviz,
/// COLLADA's up axis does not turn the mesh.
/// @throw std::invalid_argument with the file and the reason.
TriangleMesh readRobotMesh(const std::string& path);

}  // namespace softbody
