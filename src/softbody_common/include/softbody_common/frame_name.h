#pragma once

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

}  // namespace softbody
