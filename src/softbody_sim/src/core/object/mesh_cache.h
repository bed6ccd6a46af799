#pragma once

#include <functional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// A hash of a content, as a file name.
std::string contentName(const std::string& content);

/// The tet mesh of this name in $XDG_CACHE_HOME/softbody or ~/.cache/softbody. A missing one is made and
/// stored. An entry that was changed or made from other inputs is not used. Without a usable cache the mesh
/// is made every time. Both give one warning. @param name the hash of all inputs of `make`.
TetMesh cachedTetMesh(const std::string& name, const std::function<TetMesh()>& make, Warnings* warnings);

}  // namespace softbody
