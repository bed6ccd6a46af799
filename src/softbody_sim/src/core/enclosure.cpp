#include "enclosure.h"

#include <Eigen/Dense>
#include <algorithm>

#include "closest_point.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"
#include "surface_repair.h"

namespace softbody {
namespace {

constexpr double kTouching = 1e-9;  ///< of the size: as good as inside
constexpr double kMargin = 1e-4;    ///< of the size: how far beyond a point the boundary is pushed
constexpr int kRounds = 50;
constexpr double kLeastVolume = 0.2;  ///< of its first volume, which a tet keeps

/// The least movement of a triangle's corners that brings `on_boundary` beyond the point; the largest wins at
/// a corner that several points pull at.
Points outwardMoves(const std::vector<OutsidePoint>& outside, const Points& points, const TetMesh& mesh,
                    const Triangles& boundary, double margin) {
  Points moves = Points::Zero(mesh.vertices.rows(), 3);
  for (const OutsidePoint& out : outside) {
    const Eigen::RowVector3i corners = boundary.row(out.triangle);
    Eigen::Matrix3d triangle;
    for (int k = 0; k < 3; ++k) triangle.col(k) = mesh.vertices.row(corners[k]).transpose();
    const Eigen::Vector3d offset = points.row(out.point).transpose() - out.on_boundary;
    const Eigen::RowVector3d move = (offset * (1.0 + margin / out.distance)).transpose();
    Eigen::Matrix<double, 4, 3> system;
    system << triangle, Eigen::RowVector3d::Ones();
    const Eigen::Vector4d place(out.on_boundary[0], out.on_boundary[1], out.on_boundary[2], 1.0);
    const Eigen::Vector3d weights = system.colPivHouseholderQr().solve(place).cwiseMax(0.0);
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector3d share = weights[k] / weights.squaredNorm() * move;
      if (share.squaredNorm() > moves.row(corners[k]).squaredNorm()) moves.row(corners[k]) = share;
    }
  }
  return moves;
}

/// Takes back the moves of the corners of tets that would get too small, until none does.
void moveWithoutCollapse(const Eigen::VectorXd& least_volumes, Points moves, TetMesh* mesh) {
  const Points before = mesh->vertices;
  for (;;) {
    mesh->vertices = before + moves;
    const Eigen::VectorXd volumes = tetVolumes(mesh->vertices, mesh->tets);
    bool any = false;
    for (Eigen::Index t = 0; t < volumes.size(); ++t) {
      if (volumes[t] >= least_volumes[t]) continue;
      for (const int vertex : mesh->tets.row(t)) {
        any = any || !moves.row(vertex).isZero(0.0);
        moves.row(vertex).setZero();
      }
    }
    if (!any) return;
  }
}

std::vector<OutsidePoint> stillOutside(const std::vector<OutsidePoint>& before, const Points& points,
                                       const TetMesh& mesh, const Triangles& boundary) {
  Points checked(static_cast<Eigen::Index>(before.size()), 3);
  for (std::size_t i = 0; i < before.size(); ++i)
    checked.row(static_cast<Eigen::Index>(i)) = points.row(before[i].point);
  std::vector<OutsidePoint> outside = pointsOutside(checked, mesh, boundary);
  for (OutsidePoint& out : outside) out.point = before[static_cast<std::size_t>(out.point)].point;
  return outside;
}

}  // namespace

std::vector<OutsidePoint> pointsOutside(const Points& points, const TetMesh& mesh,
                                        const Triangles& boundary) {
  const TetLocator locator(mesh.vertices, mesh.tets);
  const ClosestPointQuery query(mesh.vertices, boundary);
  const double touching = kTouching * sizeOf(mesh.vertices);
  std::vector<OutsidePoint> outside;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::Vector3d point = points.row(p);
    if (locator.locate(point).barycentric.minCoeff() >= 0.0) continue;
    const SurfacePoint nearest = query.closest(point);
    const double distance = (nearest.position - point).norm();
    if (distance > touching) outside.push_back({p, nearest.triangle, nearest.position, distance});
  }
  return outside;
}

double largestDistance(const std::vector<OutsidePoint>& outside) {
  double largest = 0.0;
  for (const OutsidePoint& out : outside) largest = std::max(largest, out.distance);
  return largest;
}

bool growToEnclose(const Points& points, TetMesh* mesh) {
  const Triangles boundary = boundaryTriangles(mesh->tets);
  const Eigen::VectorXd least_volumes = kLeastVolume * tetVolumes(mesh->vertices, mesh->tets);
  const double margin = kMargin * sizeOf(mesh->vertices);
  std::vector<OutsidePoint> outside = pointsOutside(points, *mesh, boundary);
  for (int round = 0; round < kRounds && !outside.empty(); ++round) {
    moveWithoutCollapse(least_volumes, outwardMoves(outside, points, *mesh, boundary, margin), mesh);
    // Those that were outside are all that matters until they are in: then the others are looked at again.
    outside = stillOutside(outside, points, *mesh, boundary);
    if (outside.empty()) outside = pointsOutside(points, *mesh, boundary);
  }
  return pointsOutside(points, *mesh, boundary).empty();
}

}  // namespace softbody
