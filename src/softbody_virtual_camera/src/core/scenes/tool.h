#pragma once

#include <string>
#include <vector>

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// A square marker of DICT_4X4_50. Its frame: origin at the centre, x right, y up, z out.
struct ToolMarker {
  int id = 0;
  double size_m = 0.0;
  Eigen::Isometry3d T_tool_marker = Eigen::Isometry3d::Identity();
};

/// The contents of a tool YAML.
struct Tool {
  std::vector<ToolMarker> markers;
  Points blade;  ///< planar polygon in the tool frame [m]
};

/// @throw std::invalid_argument with the file and the error.
Tool readTool(const std::string& path);

/// The tool with all lengths multiplied by a factor.
Tool scaled(const Tool& tool, double factor);

/// White plates with the markers, and a steel blade with a handle, in the tool frame.
std::vector<Actor> toolActors(const Tool& tool);

}  // namespace softbody::virtual_camera
