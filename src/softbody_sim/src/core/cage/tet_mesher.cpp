#include "cage/tet_mesher.h"

#include <dlfcn.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "cage/fill_request.h"
#include "cage/program_run.h"

namespace softbody {
namespace {

constexpr double kLargestVolume = 2.0;  ///< of a tet, in regular tets of the surface's edge length

/// Ten times what a cage takes: 0.1 s for 400 vertices, 3 s for 20,000.
std::chrono::seconds timeLimit(const TriangleMesh& surface) {
  return std::chrono::seconds(5 + surface.vertices.rows() / 800);
}

/// prepare_model is installed in a folder beside this library, in the devel and in the install space.
std::filesystem::path prepareModelProgram() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<void*>(&meshInside), &library) == 0)
    throw std::runtime_error("the library softbody_sim_model does not know its place");
  return std::filesystem::absolute(library.dli_fname).parent_path() / "softbody_sim" / "prepare_model";
}

}  // namespace

TetMesh meshInside(const TriangleMesh& surface, double edge_length_m, bool keep_surface) {
  const double volume = kLargestVolume * std::pow(edge_length_m, 3) / (6.0 * std::sqrt(2.0));
  const std::optional<std::string> bytes =
      outputOfProgram(prepareModelProgram(), kFillArgument,
                      toBytes(FillRequest{surface, volume, keep_surface}), timeLimit(surface));
  if (!bytes) throw std::runtime_error("TetGen cannot fill the surface; does it touch or cross itself?");
  TetMesh mesh = tetMesh(*bytes);
  if (mesh.tets.rows() == 0) throw std::runtime_error("TetGen made no tet inside the surface");
  return mesh;
}

}  // namespace softbody
