#pragma once

#include "softbody_sim/io/tet_files.h"

namespace softbody {

/// TetGen's .node and .ele files (TetGen manual, "File formats"). @param path of either. Errors as
/// readTetFile.
TetMesh readTetGen(const std::string& path, Warnings* warnings);

/// The .tet files of Geogram ("N vertices", "M tets") and of Quartet ("tet N M"). Errors as readTetFile.
TetMesh readTet(const std::string& path, Warnings* warnings);

}  // namespace softbody
