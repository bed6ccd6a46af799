#include "softbody_evaluation/measures/rest_symmetry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/rigid_fit.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

// About the noise of the depth by which the tracker compares poses: 2 mm of a body of 200 mm.
constexpr double kLargestMisfit = 0.01;
// Angle [rad] and distance [diagonals] between two poses that the tracker counts as different, too.
constexpr double kOtherTurn = 0.35, kOtherPlace = 0.2;
// Triangles that are compared: enough for every part of a body, few enough for a fraction of a second.
constexpr Eigen::Index kMostTriangles = 500;
constexpr int kSteps = 50;  // the fit ends earlier where it stands still; 10 are usual

double diagonalOf(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

/// Corners and centres of triangles, evenly thinned out. A vertex without triangles is no part of the
/// surface.
Points pointsOf(const TriangleMesh& mesh) {
  const Eigen::Index step = 1 + mesh.triangles.rows() / kMostTriangles;
  Points points(4 * (1 + (mesh.triangles.rows() - 1) / step), 3);
  for (Eigen::Index i = 0; 4 * i < points.rows(); ++i) {
    const auto corners = mesh.triangles.row(i * step);
    for (int k = 0; k < 3; ++k) points.row(4 * i + k) = mesh.vertices.row(corners[k]);
    points.row(4 * i + 3) = points.middleRows(4 * i, 3).colwise().mean();
  }
  return points;
}

Eigen::Vector3d normalOf(const TriangleMesh& mesh, int triangle) {
  const auto corners = mesh.triangles.row(triangle);
  const Eigen::Vector3d a = mesh.vertices.row(corners[0]), b = mesh.vertices.row(corners[1]),
                        c = mesh.vertices.row(corners[2]);
  return (b - a).cross(c - a).normalized();
}

/// Fits points of a mesh to the mesh.
class SelfFit {
 public:
  explicit SelfFit(const TriangleMesh& mesh)
      : mesh_(mesh),
        query_(mesh.vertices, mesh.triangles),
        points_(pointsOf(mesh)),
        size_m_(diagonalOf(points_)) {}

  /// One Gauss-Newton step. @return how far it moves a point of the mesh, at most about [m].
  double improve(Eigen::Isometry3d* motion) const {
    const Eigen::Vector3d centre = *motion * Eigen::Vector3d(points_.colwise().mean().transpose());
    Eigen::Matrix<double, 6, 6> normal_matrix = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right_side = Eigen::Matrix<double, 6, 1>::Zero();
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::Vector3d moved = *motion * Eigen::Vector3d(points_.row(i).transpose());
      const SurfacePoint nearest = query_.closest(moved);
      const Eigen::Vector3d offset = moved - nearest.position;
      // Beside an edge the nearest point is not along the normal of a triangle.
      const bool on_surface = offset.norm() < 1e-9 * size_m_;
      const Eigen::Vector3d direction = on_surface ? normalOf(mesh_, nearest.triangle) : offset.normalized();
      Eigen::Matrix<double, 6, 1> row;
      row << (moved - centre).cross(direction) / size_m_, direction;  // all entries have one size
      normal_matrix += row * row.transpose();
      right_side -= direction.dot(offset) * row;
    }
    // Keeps the directions in which nothing changes where they are.
    normal_matrix.diagonal().array() += 1e-6 * static_cast<double>(points_.rows());
    const Eigen::Matrix<double, 6, 1> step = normal_matrix.ldlt().solve(right_side);
    const Eigen::Vector3d turn = step.head<3>() / size_m_, shift = step.tail<3>();
    Eigen::Isometry3d update = Eigen::Isometry3d::Identity();
    if (turn.norm() > 0.0) update.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
    update.translation() = centre + shift - update.linear() * centre;
    *motion = update * *motion;
    return step.norm();
  }

  double misfit(const Eigen::Isometry3d& motion) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::Vector3d moved = motion * Eigen::Vector3d(points_.row(i).transpose());
      sum += (moved - query_.closest(moved).position).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(points_.rows()));
  }

  double size() const { return size_m_; }

 private:
  const TriangleMesh& mesh_;
  ClosestPointQuery query_;
  Points points_;
  double size_m_;
};

}  // namespace

Eigen::Isometry3d motionBetween(const Points& rest, const Points& result, const Points& truth) {
  return fitRigid(rest, truth).inverse() * fitRigid(rest, result);
}

SelfMap nearestSelfMap(const TriangleMesh& mesh, const Eigen::Isometry3d& start) {
  const SelfFit fit(mesh);
  SelfMap map;
  map.motion = start;
  for (int i = 0; i < kSteps; ++i) {
    if (fit.improve(&map.motion) < 1e-9 * fit.size()) break;
  }
  map.misfit_m = fit.misfit(map.motion);
  const Eigen::Vector3d centre = mesh.vertices.colwise().mean().transpose();
  map.near_start = Eigen::AngleAxisd((map.motion.inverse() * start).linear()).angle() <= kOtherTurn &&
                   (map.motion * centre - start * centre).norm() <= kOtherPlace * fit.size();
  return map;
}

bool isSymmetry(const SelfMap& map, const TriangleMesh& mesh) {
  return map.near_start && map.misfit_m <= kLargestMisfit * diagonalOf(pointsOf(mesh));
}

}  // namespace softbody::evaluation
