#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "random_meshes.h"
#include "softbody_common/cutting/edit_history.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

inline TetTopology randomVolume(unsigned seed) {
  std::mt19937 random(seed);
  const TetMesh mesh = shakenBlock(2, 2, 1, 0.03, 0.15, &random);
  TetTopology topology;
  topology.revision = seed;
  topology.rest_vertices = mesh.vertices;
  topology.tets = mesh.tets;
  topology.surface = boundaryTriangles(mesh.tets);
  topology.tet_pieces = tetPieces(mesh.tets, static_cast<int>(mesh.vertices.rows()));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    topology.vertex_parents.push_back(static_cast<int>(v) - 1);
  topology.has_initial_pose = seed % 2 == 0;
  if (topology.has_initial_pose) topology.initial_pose = randomMotion(&random);
  return topology;
}

inline MeshTopology randomSurface(unsigned seed) {
  const TetTopology volume = randomVolume(seed);
  MeshTopology topology;
  topology.revision = seed;
  topology.rest_vertices = volume.rest_vertices;
  topology.triangles = volume.surface;
  topology.vertex_parents = volume.vertex_parents;
  topology.triangle_pieces.assign(static_cast<std::size_t>(volume.surface.rows()), 1u);
  for (Eigen::Index f = 0; f < volume.surface.rows(); ++f) topology.cut.push_back(f % 3 == 0);
  if (seed % 2 == 0) topology.texture_coordinates = Points::Random(3 * volume.surface.rows(), 3);
  return topology;
}

inline TargetSet randomTargets(unsigned seed) {
  std::mt19937 random(seed);
  TargetSet set;
  set.revision = seed;
  set.reset = seed % 2 == 1;
  set.body_pose = randomMotion(&random);
  for (int i = 0; i < 20; ++i) {
    Target target;
    target.kind = static_cast<TargetKind>(i % 5);
    target.place.tet = i;
    const Eigen::Vector3d weights = randomPoint(-2.0, 2.0, &random);
    target.place.barycentric << weights, 1.0 - weights.sum();
    target.position = randomPoint(-1.0, 1.0, &random);
    if (i % 2 == 0) target.normal = randomPoint(-1.0, 1.0, &random).normalized();
    target.weight = 0.1 + i;
    set.targets.push_back(target);
  }
  return set;
}

/// Two strokes in force, of two patches and of one, and an undone one.
inline EditHistory someEdits(unsigned seed) {
  EditHistory edits;
  for (std::uint32_t k = 0; k < 4; ++k) {
    MeshTopology mesh = randomSurface(seed + k);
    mesh.rest_vertices = mesh.rest_vertices.cast<float>().cast<double>().eval();
    addEdit({edits.revision + 1, (k + 1) / 2, CutKind::kCut, {mesh.rest_vertices, mesh.triangles}}, &edits);
  }
  addEdit({edits.revision + 1, 0, CutKind::kUndo, {}}, &edits);
  edits.body = 17;
  return edits;
}

}  // namespace softbody
