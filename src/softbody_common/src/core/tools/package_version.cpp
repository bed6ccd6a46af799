#include "softbody_common/tools/package_version.h"

namespace softbody {
namespace {

/// In a function, because programs set it before main.
std::string& text() {
  static std::string name_and_version = "softbody";
  return name_and_version;
}

}  // namespace

const std::string& packageVersion() { return text(); }

bool setPackageVersion(const char* name_and_version) {
  text() = name_and_version;
  return true;
}

}  // namespace softbody
