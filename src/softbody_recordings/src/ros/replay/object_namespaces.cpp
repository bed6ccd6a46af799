#include "softbody_recordings/ros/object_namespaces.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

namespace softbody {
namespace {

std::string nameOfObject(const std::filesystem::path& object) {
  std::filesystem::path path = std::filesystem::absolute(object).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // a folder with '/' at its end
  if (path.filename() == "object.yaml") path = path.parent_path();
  std::string name = (path.extension() == ".yaml" ? path.stem() : path.filename()).string();
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c >= 128 || (std::isalnum(c) == 0 && c != '_'); }, '_');
  return name.empty() || std::isalpha(static_cast<unsigned char>(name.front())) == 0 ? "body_" + name : name;
}

}  // namespace

std::vector<std::string> objectNamespaces(const std::vector<std::string>& objects) {
  std::set<std::string> taken;
  std::vector<std::string> namespaces;
  for (const std::string& object : objects) {
    const std::string name = "/" + nameOfObject(object);
    std::string free = name;
    for (int number = 2; !taken.insert(free).second; ++number) free = name + "_" + std::to_string(number);
    namespaces.push_back(free);
  }
  return namespaces;
}

}  // namespace softbody
