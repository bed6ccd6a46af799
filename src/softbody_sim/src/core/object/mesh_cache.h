#pragma once

#include <functional>
#include <string>

#include "softbody_common/types.h"
#include "softbody_sim/io/warnings.h"

namespace softbody {

/// A hash of a content, as a file name.
std::string contentName(const std::string& content);

/// The tet mesh of this name in $XDG_CACHE_HOME/softbody or ~/.cache/softbody. A missing one is made and
/// stored. Without a usable cache it is made every time, with a warning.
TetMesh cachedTetMesh(const std::string& name, const std::function<TetMesh()>& make, Warnings* warnings);

}  // namespace softbody
