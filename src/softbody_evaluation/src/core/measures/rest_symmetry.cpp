#include "measures/rest_symmetry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "measures/corner_weights.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

// About the noise of the depth by which the tracker compares poses: 2 mm of a body of 200 mm.
constexpr double kLargestMisfit = 0.01;
// Angle [rad] and distance [diagonals] between two poses that the tracker counts as different, too.
constexpr double kOtherTurn = 0.35, kOtherPlace = 0.2;
// Triangles that are compared: enough for every part of a body, few enough for a fraction of a second.
constexpr Eigen::Index kMostTriangles = 500;
// A motion is free, as the turn of a ball, if the surface moves along its normals by less than this share.
constexpr double kFreeMotion = 0.03;
constexpr int kSteps = 50;  // the fit ends earlier where it stands still; 10 are usual

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

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

/// Solves the normal equations, and leaves the free directions as they are.
Vector6 solvedWhereFixed(const Matrix6& normal_matrix, const Vector6& right_side) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> directions(normal_matrix);
  Vector6 inverse = directions.eigenvalues();
  const double least = kFreeMotion * kFreeMotion * inverse.maxCoeff();
  for (double& value : inverse) value = value > least ? 1.0 / value : 0.0;
  return directions.eigenvectors() * inverse.cwiseProduct(directions.eigenvectors().transpose() * right_side);
}

/// Fits points of a mesh to the mesh.
class SelfFit {
 public:
  explicit SelfFit(const TriangleMesh& mesh)
      : mesh_(mesh),
        query_(mesh.vertices, mesh.triangles),
        normals_(vertexNormals(mesh.vertices, mesh.triangles)),
        points_(pointsOf(mesh)),
        size_m_(diagonalOf(points_)) {}

  /// One Gauss-Newton step. @return how far it moves a point of the mesh, at most about [m].
  double improve(Eigen::Isometry3d* motion) const {
    const Eigen::Vector3d centre = *motion * Eigen::Vector3d(points_.colwise().mean().transpose());
    Matrix6 normal_matrix = Matrix6::Zero();
    Vector6 right_side = Vector6::Zero();
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::Vector3d moved = *motion * Eigen::Vector3d(points_.row(i).transpose());
      const SurfacePoint nearest = query_.closest(moved);
      const Eigen::Vector3d normal = normalAt(nearest);
      Vector6 row;
      row << (moved - centre).cross(normal) / size_m_, normal;  // all entries have one size
      normal_matrix += row * row.transpose();
      right_side -= normal.dot(moved - nearest.position) * row;
    }
    const Vector6 step = solvedWhereFixed(normal_matrix, right_side);
    *motion = rigidMotion(step.head<3>() / size_m_, step.tail<3>(), centre) * *motion;
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
  /// Interpolated between the corners: the facets of a ball must not hold its turn.
  Eigen::Vector3d normalAt(const SurfacePoint& place) const {
    const auto corners = mesh_.triangles.row(place.triangle);
    const Eigen::Vector3d weights =
        cornerWeights(mesh_.vertices, {corners[0], corners[1], corners[2]}, place.position);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) normal += weights[k] * normals_.row(corners[k]).transpose();
    return normal.normalized();
  }

  const TriangleMesh& mesh_;
  ClosestPointQuery query_;
  Points normals_;
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
