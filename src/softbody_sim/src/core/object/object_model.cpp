#include "softbody_sim/object/object_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "cage/enclosure.h"
#include "cage/volume_maker.h"
#include "object/mesh_cache.h"
#include "shells/shell_nesting.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/visual_mesh.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

/// To be changed with the algorithm: meshes in the cache from older versions are then ignored.
constexpr const char* kMakerVersion = "softbody volume 4";

TriangleMesh loadCage(const ObjectDescription& description, Warnings* warnings) {
  WeldedSurface cage = loadSurface(description.cage_mesh, description.unit_m, warnings);
  const EdgeReport edges = examineEdges(cage.mesh.triangles);
  if (!edges.closed() || edges.inconsistent > 0) {
    throw std::invalid_argument(fmt::format(
        "{}: the cage must be closed; {} edges have one triangle, {} more than two (one between vertices {} "
        "and {}), {} have inconsistent orientation",
        description.cage_mesh, edges.open, edges.branching,
        edges.example[0] < 0 ? -1 : cage.vertex_parents[static_cast<std::size_t>(edges.example[0])],
        edges.example[1] < 0 ? -1 : cage.vertex_parents[static_cast<std::size_t>(edges.example[1])],
        edges.inconsistent));
  }
  orientShells(&cage);
  return cage.mesh;
}

TetMesh fillCage(const ObjectDescription& description, Warnings* warnings) {
  const TriangleMesh cage = loadCage(description, warnings);
  try {
    return volumeInside(cage);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(fmt::format("{}: {}", description.cage_mesh, error.what()));
  }
}

TetMesh wrapVisual(const ObjectDescription& description, const MeshTopology& visual,
                   const VolumeSettings& settings) {
  try {
    return volumeAround({visual.rest_vertices, visual.triangles}, settings.cage_vertices, settings.progress);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(
        fmt::format("{}: no volume could be made around it: {}", description.visual_mesh, error.what()));
  }
}

/// All inputs of a volume, for the cache.
std::string volumeContent(const ObjectDescription& description, int cage_vertices) {
  const std::string cage = description.cage_mesh.empty() ? "" : readFile(description.cage_mesh);
  const std::string visual = readFile(description.visual_mesh);
  const BodyOptions& body = description.body;
  return fmt::format(
      "{}\nunit {:.17g} thickness {:.17g} length {:.17g} shell {} triangles {}\ncage vertices {}\n"
      "cage {} bytes\n{}visual {} bytes\n{}",
      kMakerVersion, description.unit_m, body.thickness, body.length_m, body.shell, body.triangles,
      description.cage_mesh.empty() ? cage_vertices : 0, cage.size(), cage, visual.size(), visual);
}

TetMesh loadTets(const ObjectDescription& description, Warnings* warnings) {
  TetMesh tets = readTetFile(description.tet_mesh, warnings);
  tets.vertices *= description.unit_m;
  if (description.cage_mesh.empty()) return tets;
  const TriangleMesh cage = loadCage(description, warnings);
  const double volume = tetVolumes(tets.vertices, tets.tets).sum();
  const double enclosed = enclosedVolume(cage.vertices, cage.triangles);
  if (std::abs(enclosed - volume) > 1e-6 * volume) {
    warnings->push_back(
        fmt::format("{}: is not the boundary of {} (it encloses {:.6g} m^3, the tets fill {:.6g}); the "
                    "boundary of the tets is used",
                    description.cage_mesh, description.tet_mesh, enclosed, volume));
  }
  return tets;
}

TetMesh loadOrMakeVolume(const ObjectDescription& description, const MeshTopology& visual,
                         const VolumeSettings& settings, Warnings* warnings) {
  if (!description.tet_mesh.empty()) return loadTets(description, warnings);
  // Warnings about the cage are not cached. They are given here, so that a cached volume warns like a new
  // one.
  if (!description.cage_mesh.empty()) loadCage(description, warnings);
  const auto make = [&] {
    Warnings already_given;
    if (!description.cage_mesh.empty()) return fillCage(description, &already_given);
    return wrapVisual(description, visual, settings);
  };
  if (!settings.use_cache) return make();
  return cachedTetMesh(contentName(volumeContent(description, settings.cage_vertices)), make, warnings);
}

TetTopology toTopology(TetMesh mesh, const std::optional<Eigen::Isometry3d>& initial_pose) {
  TetTopology topology;
  topology.surface = boundaryTriangles(mesh.tets);
  topology.tet_pieces = tetPieces(mesh.tets, static_cast<int>(mesh.vertices.rows()));
  topology.vertex_parents.resize(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(topology.vertex_parents.begin(), topology.vertex_parents.end(), 0);
  topology.rest_vertices = std::move(mesh.vertices);
  topology.tets = std::move(mesh.tets);
  topology.has_initial_pose = initial_pose.has_value();
  topology.initial_pose = initial_pose.value_or(Eigen::Isometry3d::Identity());
  return topology;
}

void warnOfEnclosure(const MeshTopology& visual, const TetTopology& volume, Warnings* warnings) {
  const auto outside =
      pointsOutside(visual.rest_vertices, {volume.rest_vertices, volume.tets}, volume.surface);
  if (outside.empty()) return;
  warnings->push_back(fmt::format(
      "{} of {} visual vertices lie outside of the tets, by up to {:.2g} mm; they follow the nearest tet",
      outside.size(), visual.rest_vertices.rows(), 1e3 * largestDistance(outside)));
}

void warnOfPieces(const TetTopology& volume, Warnings* warnings) {
  const std::uint32_t last = *std::max_element(volume.tet_pieces.begin(), volume.tet_pieces.end());
  if (last > 0)
    warnings->push_back(fmt::format(
        "the volume has {} separate pieces; if the body is one piece, join them in the mesh", last + 1));
  const EdgeReport edges = examineEdges(volume.surface);
  if (edges.branching > 0) {
    warnings->push_back(
        fmt::format("the tets' boundary touches itself along {} edges; if the body does not touch itself "
                    "there, make finer tets",
                    edges.branching));
  }
}

}  // namespace

ObjectModel buildObjectModel(const ObjectDescription& description, const VolumeSettings& settings) {
  ObjectModel model;
  model.warnings = description.warnings;
  model.material = description.material;
  model.visual = loadVisualMesh(description, &model.warnings);
  model.volume = toTopology(loadOrMakeVolume(description, model.visual, settings, &model.warnings),
                            description.initial_pose);
  warnOfPieces(model.volume, &model.warnings);
  warnOfEnclosure(model.visual, model.volume, &model.warnings);
  return model;
}

}  // namespace softbody
