#pragma once

#include <string>

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// TetGen's .node and .ele files (TetGen manual, "File formats"). The orientation of the tets is as in the
/// file; their indices are checked. @param path of either file. @throw std::invalid_argument with file, line
/// and error.
TetMesh readTetGen(const std::string& path);

}  // namespace softbody
