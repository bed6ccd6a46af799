#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/types.h"

namespace softbody {

/// A square ArUco marker on a tool. Its frame: origin at the centre, x right, y up, z out of the print.
struct ToolMarker {
  int id = 0;
  double size_m = 0.0;  ///< side of the black square
  Eigen::Isometry3d T_tool_marker = Eigen::Isometry3d::Identity();
};

/// The content of a tool YAML.
struct ToolDescription {
  std::string dictionary;           ///< see MarkerDetector
  std::vector<ToolMarker> markers;  ///< with different ids
  Points blade;                     ///< planar polygon in the tool frame [m]; empty: a tool without a blade
  std::vector<std::string> warnings;
};

/// Reads a tool YAML. A tool may be at most 2 m long. @param scope where a dictionary file may be.
/// @throw std::invalid_argument with file, line, key, value and what is allowed.
ToolDescription loadToolDescription(const std::string& yaml_path, FileScope scope = FileScope::kOwnFolder);

/// A marker's corners in the tool frame [m], in the order of MarkerDetection: clockwise on the print,
/// starting at its top left.
Eigen::Matrix<double, 3, 4> markerCorners(const ToolMarker& marker);

}  // namespace softbody
