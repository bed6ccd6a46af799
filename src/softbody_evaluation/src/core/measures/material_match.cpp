#include "measures/material_match.h"

#include <Eigen/Dense>
#include <limits>
#include <utility>

#include "measures/corner_weights.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_evaluation/measures/vertex_match.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

// Share of the mesh's diagonal: places that are nearer are the same place. Single precision rounds by less.
constexpr double kSamePlace = 1e-6;

double samePlaceOf(const Points& vertices) {
  return kSamePlace * (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

std::array<int, 3> cornersOf(const Triangles& triangles, Eigen::Index f) {
  return {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
}

/// The triangles of the input file around each vertex. Those that fill a cut are left out.
std::vector<std::vector<int>> trianglesAround(const MeshTopology& mesh) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(mesh.rest_vertices.rows()));
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (mesh.cut[static_cast<std::size_t>(f)]) continue;
    for (int k = 0; k < 3; ++k)
      around[static_cast<std::size_t>(mesh.triangles(f, k))].push_back(static_cast<int>(f));
  }
  return around;
}

/// The place of a point in the nearest of some triangles.
PlaceBetween nearestPlace(const MeshTopology& mesh, const std::vector<int>& triangles,
                          const Eigen::Vector3d& point) {
  PlaceBetween place;
  double least = std::numeric_limits<double>::infinity();
  for (const int f : triangles) {
    const std::array<int, 3> corners = cornersOf(mesh.triangles, f);
    const Eigen::Vector3d nearest =
        nearestOnTriangle(point, mesh.rest_vertices.row(corners[0]), mesh.rest_vertices.row(corners[1]),
                          mesh.rest_vertices.row(corners[2]));
    if ((nearest - point).norm() >= least) continue;
    least = (nearest - point).norm();
    place.corners = corners;
    place.weights = cornerWeights(mesh.rest_vertices, corners, nearest);
  }
  return place;
}

}  // namespace

MaterialMap materialMap(const Eigen::Isometry3d& motion, const MeshTopology& mesh,
                        const MeshTopology& truth) {
  MaterialMap map;
  map.motion = motion;
  const ClosestPointQuery query(truth.rest_vertices, truth.triangles);
  const double same_place = samePlaceOf(truth.rest_vertices);
  for (Eigen::Index v = 0; v < mesh.rest_vertices.rows(); ++v) {
    const int parent = mesh.vertex_parents[static_cast<std::size_t>(v)];
    const Eigen::Vector3d place = motion * Eigen::Vector3d(mesh.rest_vertices.row(v).transpose());
    const bool in_both =
        v < truth.rest_vertices.rows() && truth.vertex_parents[static_cast<std::size_t>(v)] == parent;
    if (in_both && (place - truth.rest_vertices.row(v).transpose()).norm() <= same_place) {
      map.parents[parent] = parent;
      continue;
    }
    const SurfacePoint nearest = query.closest(place);
    const std::array<int, 3> corners = cornersOf(truth.triangles, nearest.triangle);
    int heaviest = 0;
    cornerWeights(truth.rest_vertices, corners, nearest.position).maxCoeff(&heaviest);
    map.parents[parent] =
        truth.vertex_parents[static_cast<std::size_t>(corners[static_cast<std::size_t>(heaviest)])];
  }
  map.parents.erase(-1);
  return map;
}

MeshTopology inTruthMaterial(const MaterialMap& map, MeshTopology result) {
  if (map.parents.empty()) return result;
  result.rest_vertices = transformed(result.rest_vertices, map.motion);
  for (int& parent : result.vertex_parents) {
    const auto image = map.parents.find(parent);
    parent = image == map.parents.end() ? -1 : image->second;
  }
  return result;
}

VertexMatches matchMaterial(const MaterialMap& map, const MeshTopology& result, const MeshTopology& truth,
                            double largest_m) {
  const MeshTopology moved = inTruthMaterial(map, result);
  VertexMatches matches{matchVertices(moved, truth, largest_m), {}};
  if (map.parents.empty()) return matches;
  const double same_place = samePlaceOf(truth.rest_vertices);
  const std::vector<std::vector<int>> around = trianglesAround(truth);
  for (std::size_t i = 0; i < matches.vertices.size(); ++i) {
    const int match = matches.vertices[i];
    if (match < 0 || moved.vertex_parents[i] < 0) continue;
    const Eigen::Vector3d place = moved.rest_vertices.row(static_cast<Eigen::Index>(i));
    if ((place - truth.rest_vertices.row(match).transpose()).norm() <= same_place) continue;
    PlaceBetween between = nearestPlace(truth, around[static_cast<std::size_t>(match)], place);
    between.vertex = static_cast<int>(i);
    if (between.corners[0] >= 0) matches.between.push_back(between);
  }
  return matches;
}

MeshState ontoVertices(MeshState result, const MeshState& truth, const VertexMatches& matches) {
  for (const PlaceBetween& between : matches.between) {
    Eigen::RowVector3d place = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k)
      place += between.weights[k] * truth.vertices.row(between.corners[static_cast<std::size_t>(k)]);
    const int match = matches.vertices[static_cast<std::size_t>(between.vertex)];
    result.vertices.row(between.vertex) += truth.vertices.row(match) - place;
  }
  return result;
}

}  // namespace softbody::evaluation
