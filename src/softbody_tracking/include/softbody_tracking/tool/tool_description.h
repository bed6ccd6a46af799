#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// A square ArUco marker on a tool. Its frame: origin at its centre, x right, y up, z out of the print.
struct ToolMarker {
  int id = 0;
  double size_m = 0.0;  ///< side of the black square
  Eigen::Isometry3d T_tool_marker = Eigen::Isometry3d::Identity();
};

/// What a tool YAML says.
struct ToolDescription {
  std::string dictionary;           ///< as MarkerDetector takes it
  std::vector<ToolMarker> markers;  ///< ids differ
  Points blade;                     ///< planar polygon in the tool frame [m]; empty: a tool without a blade
  std::vector<std::string> warnings;
};

/// @throw std::invalid_argument with file, line, key, value and what is allowed; a tool spans at most 2 m.
ToolDescription loadToolDescription(const std::string& yaml_path);

/// A marker's corners in the tool frame [m], in the order in which they are detected: clockwise on the print
/// from its top left.
Eigen::Matrix<double, 3, 4> markerCorners(const ToolMarker& marker);

}  // namespace softbody
