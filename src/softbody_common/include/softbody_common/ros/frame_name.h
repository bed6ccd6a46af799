#pragma once

#include <ros/node_handle.h>

#include <string>

namespace softbody {

/// The name as tf2 has it: without the leading slash of ROS before 2012.
inline std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// The frame of one graph's body or tool: the name alone in the default namespace /softbody and outside of
/// any, "left/softbody" in the namespace /left.
inline std::string frameInNamespace(const std::string& name_space, const std::string& name) {
  const std::string prefix = withoutSlash(name_space);
  return prefix.empty() || prefix == "softbody" ? name : prefix + "/" + name;
}

/// A frame's name from a message or a parameter, without a leading slash, which tf2 refuses. The first time
/// that a name has one, a warning says so.
/// @param owner where the name comes from, for the warning, e.g. "parameter output_frame".
std::string frameName(const std::string& frame, const std::string& owner);

/// The frame of this graph's body or tool: that of the parameter, or if it is empty the name in the node's
/// namespace. So two graphs have two frames.
/// @param key the parameter's, for the warning.
std::string ownFrame(const std::string& frame, const char* key, const ros::NodeHandle& private_handle,
                     const std::string& name);

/// The default of such a parameter for the documentation.
std::string ownFrameText(const std::string& name);

}  // namespace softbody
