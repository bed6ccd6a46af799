#pragma once

#include <string>

namespace softbody {

/// Name and version of the running program's package, from its package.xml: "softbody_sim 0.1.0".
const std::string& packageVersion();

/// Sets packageVersion(). softbody_program() in CMake makes each program call it before main. @return true
bool setPackageVersion(const char* name_and_version);

}  // namespace softbody
