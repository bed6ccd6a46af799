#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "corpus/mesh_checks.h"
#include "corpus/model_corpus.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"

namespace {

using namespace softbody;

/// The closed surfaces of a folder.
std::vector<test::SoundMesh> soundMeshes(const std::string& folder, const std::string& scratch) {
  std::vector<test::SoundMesh> sound;
  for (const test::CorpusMesh& file : test::modelCorpus(folder)) {
    const TriangleMesh mesh = test::surfaceOf(file, scratch);
    if (isClosed(mesh.triangles)) sound.push_back({file.name, mesh});
  }
  return sound;
}

}  // namespace

/// Prepares meshes with defects and prints what comes of them. Exit code 1 if a result is wrong.
int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: check_meshes SEED [FOLDER WITH MORE MESHES]\n";
    return 2;
  }
  const auto seed = static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10));
  std::string scratch = (std::filesystem::temp_directory_path() / "softbody_meshes_XXXXXX").string();
  if (mkdtemp(scratch.data()) == nullptr) return 1;
  std::vector<test::MutatedMesh> meshes;
  for (const test::SoundMesh& sound : test::simpleMeshes())
    for (test::MutatedMesh& mesh : test::mutationsOf(sound, seed)) meshes.push_back(std::move(mesh));
  // Of the others, one defect each.
  if (argc > 2) {
    std::size_t next = seed;
    for (const test::SoundMesh& sound : soundMeshes(argv[2], scratch)) {
      std::vector<test::MutatedMesh> all = test::mutationsOf(sound, seed);
      meshes.push_back(std::move(all[next++ % all.size()]));
    }
  }
  int faulty = 0;
  fmt::print("{:<34} {:<28} {:>9} {:>10} {:>10} {:>6}  {}\n", "mesh", "defect", "triangles", "right/cm3",
             "volume/cm3", "s", "outcome");
  for (const test::MutatedMesh& mesh : meshes) {
    const test::CheckedMesh checked = test::checkMesh(mesh, scratch, seed);
    fmt::print("{:<34} {:<28} {:>9} {:>10.4g} {:>10.4g} {:>6.2f}  {}\n", mesh.base, mesh.kind,
               mesh.mesh.triangles.rows(), 1e6 * mesh.volume.value_or(0.0), 1e6 * checked.volume,
               checked.seconds, checked.outcome.substr(0, checked.outcome.find('\n')));
    if (!checked.fault.empty()) fmt::print("  FAULT {}\n", checked.fault);
    faulty += checked.fault.empty() ? 0 : 1;
    std::cout << std::flush;
  }
  std::filesystem::remove_all(scratch);
  fmt::print("{} meshes, {} with faults\n", meshes.size(), faulty);
  return faulty == 0 ? 0 : 1;
}
