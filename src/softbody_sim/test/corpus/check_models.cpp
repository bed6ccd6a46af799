#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "corpus/model_corpus.h"

/// Prepares a model of every mesh under a folder and prints the results. Exit code 1 if a model has a fault.
int main(int argc, char** argv) {
  using namespace softbody;
  if (argc < 2) {
    std::cerr << "usage: check_models FOLDER [CAGE_VERTICES]\n";
    return 2;
  }
  std::string scratch = (std::filesystem::temp_directory_path() / "softbody_corpus_XXXXXX").string();
  if (mkdtemp(scratch.data()) == nullptr) return 1;
  int faulty = 0;
  fmt::print("{:<42} {:>7} {:>5} {:>6} {:>7} {:>9} {:>6} {:>7} {:>9} {:>6}\n", "mesh", "visual", "cage",
             "tets", "volume", "margin/mm", "spread", "dihedral", "mvc/size", "s");
  for (const test::CorpusMesh& mesh : test::modelCorpus(argv[1])) {
    const test::PreparedModel p = test::prepareAndCheck(mesh, scratch, argc > 2 ? std::atoi(argv[2]) : 0);
    const ModelQuality& q = p.quality;
    fmt::print("{:<42} {:>7} {:>5} {:>6} {:>7.2f} {:>9.3g} {:>6.2f} {:>7.1f} {:>9.1e} {:>6.2f}\n", mesh.name,
               q.visual_vertices, q.cage_vertices, q.tets,
               q.visual_volume > 0.0 ? q.cage_volume / q.visual_volume : 0.0, 1e3 * q.mean_margin,
               q.edge_spread, q.smallest_dihedral, q.size > 0.0 ? q.reproduction_error / q.size : 0.0,
               p.seconds);
    for (const std::string& fault : p.faults) fmt::print("  FAULT {}\n", fault);
    faulty += p.faults.empty() ? 0 : 1;
    std::cout << std::flush;
  }
  std::filesystem::remove_all(scratch);
  fmt::print("{} meshes with faults\n", faulty);
  return faulty == 0 ? 0 : 1;
}
