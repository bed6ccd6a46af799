#include "corpus/model_corpus.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>

#include "cage/enclosure.h"
#include "shells/shell_nesting.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"
#include "surface_mesh/surface_repair.h"

namespace softbody::test {
namespace {

namespace fs = std::filesystem;

constexpr double kAccuracy = 1e-6;      ///< of mean value coordinates [size]
constexpr double kSmallestAngle = 2.0;  ///< smallest allowed dihedral angle [degrees]

std::string writeBoundary(const CorpusMesh& mesh, const std::string& scratch) {
  Warnings warnings;
  const TetMesh tets = readTetFile(mesh.path, &warnings);
  const std::string path = scratch + "/boundary.obj";
  writeObj(path, {tets.vertices, boundaryTriangles(tets.tets)});
  return path;
}

std::vector<std::string> faultsOf(const ModelQuality& q) {
  std::vector<std::string> faults;
  const auto expect = [&faults](bool holds, const std::string& fault) {
    if (!holds) faults.push_back(fault);
  };
  expect(q.outside == 0, fmt::format("{} visual vertices outside", q.outside));
  expect(q.smallest_tet > 0.0, fmt::format("a tet of volume {:.3g}", q.smallest_tet));
  expect(q.smallest_dihedral > kSmallestAngle, fmt::format("dihedral angle {:.2f}", q.smallest_dihedral));
  expect(q.partition_error < kAccuracy, fmt::format("weights sum to 1 + {:.2g}", q.partition_error));
  expect(q.reproduction_error < kAccuracy * q.size,
         fmt::format("vertices reproduced to {:.2g} of the size", q.reproduction_error / q.size));
  return faults;
}

}  // namespace

std::vector<CorpusMesh> modelCorpus(const std::string& folder) {
  const std::set<std::string> surfaces{".obj", ".off", ".ply", ".stl"}, tets{".vtu", ".msh", ".veg", ".ele"};
  std::vector<CorpusMesh> corpus;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.path().filename() == "beam3.veg") continue;                     // of cubes
    if (entry.path().string().find("/wild/") != std::string::npos) continue;  // not all give a model
    const bool is_tet_mesh = tets.count(extension) > 0;
    if (!is_tet_mesh && surfaces.count(extension) == 0) continue;
    corpus.push_back({fs::relative(entry.path(), folder).string(), entry.path().string(), is_tet_mesh});
  }
  std::sort(corpus.begin(), corpus.end(),
            [](const CorpusMesh& a, const CorpusMesh& b) { return a.name < b.name; });
  return corpus;
}

TriangleMesh surfaceOf(const CorpusMesh& mesh, const std::string& scratch) {
  Warnings ignored;
  WeldedSurface surface =
      loadSurface(mesh.is_tet_mesh ? writeBoundary(mesh, scratch) : mesh.path, 1.0, &ignored);
  orientShells(&surface);
  return surface.mesh;
}

PreparedModel prepareAndCheck(const CorpusMesh& mesh, const std::string& scratch, int cage_vertices) {
  PreparedModel prepared;
  try {
    ObjectDescription description;
    description.visual_mesh = mesh.is_tet_mesh ? writeBoundary(mesh, scratch) : mesh.path;
    VolumeSettings settings;
    settings.use_cache = false;
    settings.cage_vertices = cage_vertices;
    const auto begin = std::chrono::steady_clock::now();
    const ObjectModel model = buildObjectModel(description, settings);
    prepared.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    prepared.quality = measureModel(model);
    prepared.faults = faultsOf(prepared.quality);
  } catch (const std::exception& error) {
    prepared.faults.push_back(error.what());
  }
  return prepared;
}

}  // namespace softbody::test
