#pragma once

#include <functional>
#include <string>

#include "softbody_common/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// A name for a content: equal contents have equal names.
std::string contentName(const std::string& content);

/// The tet mesh kept under this name in $XDG_CACHE_HOME/softbody or ~/.cache/softbody; made and kept if there
/// is none. Without a usable cache it is made every time, with a warning.
TetMesh cachedTetMesh(const std::string& name, const std::function<TetMesh()>& make, Warnings* warnings);

}  // namespace softbody
