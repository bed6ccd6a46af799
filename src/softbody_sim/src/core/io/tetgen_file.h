#pragma once

#include <string>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// TetGen's .node and .ele files (TetGen manual, "File formats"). Tets come in any orientation, with checked
/// indices. @param path of either file. @throw std::invalid_argument with file, line and error.
TetMesh readTetGen(const std::string& path);

}  // namespace softbody
