#pragma once

#include <string>
#include <vector>

namespace softbody {

/// The namespaces of several bodies: each is the name of its object's file, or of the folder if the file is
/// object.yaml, as "/sponge". A character that no ROS name has becomes '_'. The second body of a name
/// has "_2" at the end.
/// @param objects object YAMLs, or their folders.
std::vector<std::string> objectNamespaces(const std::vector<std::string>& objects);

}  // namespace softbody
