#include "core/cutting/tearing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>
#include <map>

#include "core/cutting/cut_patch.h"
#include "core/cutting/manifold.h"

namespace softbody {
namespace {

Eigen::Matrix3d edgesOf(const Points& vertices, const Eigen::RowVector4i& tet) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = vertices.row(tet[k + 1]) - vertices.row(tet[0]);
  return edges;
}

/// Green strain of a tet: (F^T F - I) / 2.
Eigen::Matrix3d strainOf(const TetTopology& topology, const Points& vertices, Eigen::Index tet) {
  const Eigen::RowVector4i corners = topology.tets.row(tet);
  const Eigen::Matrix3d F = edgesOf(vertices, corners) * edgesOf(topology.rest_vertices, corners).inverse();
  return 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity());
}

Eigen::Vector3d restNormal(const Points& vertices, const Face& face) {
  const Eigen::Vector3d first = vertices.row(face[1]) - vertices.row(face[0]);
  const Eigen::Vector3d second = vertices.row(face[2]) - vertices.row(face[0]);
  return first.cross(second).normalized();
}

/// The tets as they are, as a subdivision without splits.
CutSubdivision undivided(const TetTopology& topology) {
  CutSubdivision same;
  same.vertices = inSinglePrecision(topology.rest_vertices);
  same.parts.tets = topology.tets;
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) same.parts.parents.push_back(t);
  return same;
}

}  // namespace

std::vector<Face> overstrainedFaces(const TetTopology& topology, const Points& vertices,
                                    double strain_limit) {
  std::map<Face, Eigen::Matrix3d> first_strains;  // of the faces seen once
  std::vector<Face> faces;
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) {
    const Eigen::Matrix3d strain = strainOf(topology, vertices, t);
    for (int k = 0; k < 4; ++k) {
      const Face face = faceOf(topology.tets, t, k);
      const auto [other, is_first] = first_strains.emplace(face, strain);
      if (is_first) continue;
      const Eigen::Vector3d normal = restNormal(topology.rest_vertices, face);
      if (0.5 * normal.dot((strain + other->second) * normal) > strain_limit) faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::optional<TetEdit> tearTets(const TetTopology& topology, const std::vector<bool>& cut,
                                const Points& vertices, double strain_limit,
                                std::vector<Face>* closed_faces) {
  const std::vector<Face> strained = overstrainedFaces(topology, vertices, strain_limit);
  std::vector<Face> faces;
  std::set_union(strained.begin(), strained.end(), closed_faces->begin(), closed_faces->end(),
                 std::back_inserter(faces));
  const auto count = static_cast<int>(topology.rest_vertices.rows());
  const ManifoldCrack crack =
      openManifoldCrack(topology.tets, count, faces, nonManifoldVertices(topology.surface));
  *closed_faces = crack.closed_faces;
  if (crack.opened.copied_from.empty()) return std::nullopt;
  return assembleEdit(topology, cut, undivided(topology), crack);
}

}  // namespace softbody
