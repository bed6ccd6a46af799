#include "report/model_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "cage/enclosure.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/mean_value/mean_value_coordinates.h"
#include "softbody_sim/surface_mesh/closest_point.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

double percentile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Angle at edge (a, b) between the faces to c and to d [degrees].
double dihedralAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                     const Eigen::Vector3d& d) {
  const Eigen::Vector3d axis = (b - a).normalized();
  const Eigen::Vector3d u = axis.cross(c - a), v = axis.cross(d - a);
  return kDegrees * std::atan2(u.cross(v).norm(), u.dot(v));
}

void measureTets(const TetMesh& mesh, ModelQuality* quality) {
  const Eigen::MatrixX2d angles = dihedralAngles(mesh);
  const Eigen::VectorXd smallest = angles.col(0);
  quality->smallest_tet = tetVolumes(mesh.vertices, mesh.tets).minCoeff();
  quality->smallest_dihedral = smallest.minCoeff();
  quality->dihedral_percentile = percentile({smallest.begin(), smallest.end()}, 0.01);
  quality->largest_dihedral = angles.col(1).maxCoeff();
}

void measureMargins(const Points& points, const TriangleMesh& cage, ModelQuality* quality) {
  const ClosestPointQuery query(cage.vertices, cage.triangles);
  Eigen::VectorXd margins(points.rows());
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::Vector3d point = points.row(p);
    margins[p] = (query.closest(point).position - point).norm();
  }
  quality->least_margin = margins.minCoeff();
  quality->mean_margin = margins.mean();
  quality->largest_margin = margins.maxCoeff();
}

void measureCoordinates(const Points& points, const TriangleMesh& cage, ModelQuality* quality) {
  constexpr Eigen::Index kAtOnce = 1024;  // points: all weights of a large mesh do not fit
  const MeanValueCage mean_value(cage.vertices, cage.triangles);
  WeightRows weights;
  for (Eigen::Index first = 0; first < points.rows(); first += kAtOnce) {
    const Points some = points.middleRows(first, std::min(kAtOnce, points.rows() - first));
    mean_value.coordinates(some, &weights);
    const double partition = (weights.rowwise().sum().array() - 1.0).abs().maxCoeff();
    const double reproduction = (weights * cage.vertices - some).rowwise().norm().maxCoeff();
    quality->partition_error = std::max(quality->partition_error, partition);
    quality->reproduction_error = std::max(quality->reproduction_error, reproduction);
  }
}

double edgeSpread(const TriangleMesh& cage) {
  std::vector<double> lengths;
  for (Eigen::Index f = 0; f < cage.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = cage.triangles(f, k), b = cage.triangles(f, (k + 1) % 3);
      if (a < b) lengths.push_back((cage.vertices.row(a) - cage.vertices.row(b)).norm());
    }
  }
  return percentile(lengths, 0.95) / percentile(lengths, 0.05);
}

}  // namespace

Eigen::MatrixX2d dihedralAngles(const TetMesh& mesh) {
  static constexpr int kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                       {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  Eigen::MatrixX2d angles(mesh.tets.rows(), 2);
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    const auto corner = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(mesh.tets(t, k)); };
    angles.row(t) << 180.0, 0.0;
    for (const auto& e : kEdges) {
      const double angle = dihedralAngle(corner(e[0]), corner(e[1]), corner(e[2]), corner(e[3]));
      angles(t, 0) = std::min(angles(t, 0), angle);
      angles(t, 1) = std::max(angles(t, 1), angle);
    }
  }
  return angles;
}

TriangleMesh cageOf(const TetTopology& volume) {
  std::map<int, int> index;
  TriangleMesh cage;
  for (const int vertex : volume.surface.reshaped()) index.emplace(vertex, 0);
  cage.vertices.resize(static_cast<Eigen::Index>(index.size()), 3);
  int next = 0;
  for (auto& [vertex, number] : index) {
    cage.vertices.row(next) = volume.rest_vertices.row(vertex);
    number = next++;
  }
  cage.triangles = volume.surface.unaryExpr([&index](int vertex) { return index.at(vertex); });
  return cage;
}

ModelQuality measureModel(const ObjectModel& model) {
  const TetMesh tets{model.volume.rest_vertices, model.volume.tets};
  const TriangleMesh cage = cageOf(model.volume);
  ModelQuality quality;
  quality.visual_vertices = static_cast<int>(model.visual.rest_vertices.rows());
  quality.visual_triangles = static_cast<int>(model.visual.triangles.rows());
  quality.cage_vertices = static_cast<int>(cage.vertices.rows());
  quality.cage_triangles = static_cast<int>(cage.triangles.rows());
  quality.tet_vertices = static_cast<int>(tets.vertices.rows());
  quality.tets = static_cast<int>(tets.tets.rows());
  quality.size = sizeOf(model.visual.rest_vertices);
  quality.cage_volume = enclosedVolume(cage.vertices, cage.triangles);
  if (examineEdges(model.visual.triangles).closed()) {
    quality.visual_volume = enclosedVolume(model.visual.rest_vertices, model.visual.triangles);
  }
  quality.outside =
      static_cast<int>(pointsOutside(model.visual.rest_vertices, tets, model.volume.surface).size());
  quality.edge_spread = edgeSpread(cage);
  measureTets(tets, &quality);
  measureMargins(model.visual.rest_vertices, cage, &quality);
  measureCoordinates(model.visual.rest_vertices, cage, &quality);
  return quality;
}

}  // namespace softbody
