#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A robot's link as a camera can see it.
struct RobotLink {
  std::string name;      ///< also its tf frame
  TriangleMesh surface;  ///< in the link's frame [m]
};

/// The links of a robot that have a surface.
struct RobotDescription {
  std::string name;
  std::vector<RobotLink> links;
  std::vector<std::string> warnings;  ///< a sentence for each shape that cannot be used
};

/// Reads the mesh that a URDF names, e.g. "package://robot/meshes/link.stl", in the file's units.
/// Throws std::exception with the reason.
using RobotMeshReader = std::function<TriangleMesh(const std::string& name)>;

/// The links' surfaces from a URDF. Takes the visual geometry. A link without it, or whose visual geometry
/// cannot be used, has its collision geometry.
/// @throw std::invalid_argument with the parser's reason, or if no link has a surface.
RobotDescription readRobotDescription(const std::string& urdf, const RobotMeshReader& read_mesh);

}  // namespace softbody
