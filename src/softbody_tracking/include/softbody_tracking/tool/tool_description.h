#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A square ArUco marker on a tool. Its frame: origin at the centre, x right, y up, z out of the print.
struct ToolMarker {
  int id = 0;
  double size_m = 0.0;  ///< side of the black square
  Eigen::Isometry3d T_tool_marker = Eigen::Isometry3d::Identity();
};

/// The content of a tool YAML. A tool has either markers or a frame of tf.
struct ToolDescription {
  std::string dictionary;           ///< see MarkerDetector; empty without markers
  std::vector<ToolMarker> markers;  ///< with different ids
  Points blade;                     ///< planar polygon in the tool frame [m]; empty: a tool without a blade
  std::vector<std::string> warnings;
  std::string frame = {};  ///< frame of tf that is the tool frame; empty: the tool has markers
};

/// Reads a tool YAML. A tool may be at most 2 m long. @param scope where a dictionary file may be.
/// @throw std::invalid_argument with file, line, key, value and what is allowed.
ToolDescription loadToolDescription(const std::string& yaml_path, FileScope scope = FileScope::kOwnFolder);
/// The same for a program that looks for markers. @throw std::invalid_argument also for a tool without them.
ToolDescription loadToolWithMarkers(const std::string& yaml_path, FileScope scope = FileScope::kOwnFolder);

/// The tool with a frame of tf as its tool frame, in place of its markers. @param frame empty: as it is.
ToolDescription inFrame(ToolDescription tool, const std::string& frame);

/// A marker's corners in the tool frame [m], in the order of MarkerDetection: clockwise on the print,
/// starting at its top left.
Eigen::Matrix<double, 3, 4> markerCorners(const ToolMarker& marker);

}  // namespace softbody
