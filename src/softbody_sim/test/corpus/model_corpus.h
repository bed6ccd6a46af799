#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/model_quality.h"

namespace softbody::test {

/// A surface of ../shared/data: a file, or the boundary of a tet mesh.
struct CorpusMesh {
  std::string name;
  std::string path;
  bool is_tet_mesh = false;
};

/// All of them under a folder, in the order of their names.
std::vector<CorpusMesh> modelCorpus(const std::string& folder);

/// The repaired surface of a file, or the boundary of its tets. Files go to `scratch`.
TriangleMesh surfaceOf(const CorpusMesh& mesh, const std::string& scratch);

struct PreparedModel {
  ModelQuality quality;
  double seconds = 0.0;
  std::vector<std::string> faults;  ///< faults of the prepared model; empty: none
};

/// Prepares a model with default settings and looks for faults. Files go to `scratch`.
/// @param cage_vertices 0: the default.
PreparedModel prepareAndCheck(const CorpusMesh& mesh, const std::string& scratch, int cage_vertices = 0);

}  // namespace softbody::test
