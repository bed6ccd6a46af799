#include "cage/cage_fitting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "cage/half_spaces.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/mean_value/mean_value_coordinates.h"
#include "softbody_sim/surface_mesh/closest_point.h"
#include "surface_mesh/self_intersection.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

constexpr int kSweeps = 6;                 ///< a bound: kMinGain ends it
constexpr int kMostUndos = 8;              ///< rounds of a sweep; one or two are usual
constexpr double kMinGain = 4e-3;          ///< relative decrease of the volume below which fitting stops
constexpr double kPlaneMargin = 1e-5;      ///< distance of the points from the planes, over the size
constexpr double kMinMoveCosine = 0.7;     ///< cosine of the angle by which a move may turn a triangle
constexpr double kMinFittedHeight = 0.25;  ///< height of a triangle over its longest edge

struct Corner {
  Eigen::Index triangle;
  int next, last;  ///< the triangle's other vertices, in its direction
};

class CageFitter {
 public:
  CageFitter(const TriangleMesh& cage, const Points& points)
      : cage_(cage), points_(points), margin_(kPlaneMargin * sizeOf(cage.vertices)) {
    corners_.resize(static_cast<std::size_t>(cage.vertices.rows()));
    for (Eigen::Index f = 0; f < cage.triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        corners_[static_cast<std::size_t>(cage.triangles(f, k))].push_back(
            {f, cage.triangles(f, (k + 1) % 3), cage.triangles(f, (k + 2) % 3)});
      }
    }
  }

  /// Moves every vertex once. A move can leave a point outside, beside a triangle that the point is not
  /// assigned to. Such moves are undone, or all of them if that does not help.
  TriangleMesh sweep() {
    const Points before = cage_.vertices;
    assignPoints();
    for (Eigen::Index v = 0; v < cage_.vertices.rows(); ++v) moveVertex(v);
    for (int k = 0; k < kMostUndos; ++k) {
      const std::vector<Eigen::Index> beyond = pointsBeyond(points_, cage_);
      if (beyond.empty()) return cage_;
      if (!undoMoves(beyond, before)) break;
    }
    cage_.vertices = before;
    return cage_;
  }

 private:
  /// Assigns each point to the nearest triangle.
  void assignPoints() {
    const ClosestPointQuery query(cage_.vertices, cage_.triangles);
    below_.assign(static_cast<std::size_t>(cage_.triangles.rows()), {});
    for (Eigen::Index p = 0; p < points_.rows(); ++p) {
      below_[static_cast<std::size_t>(query.closest(points_.row(p)).triangle)].push_back(p);
    }
  }

  /// @return whether any vertex near the points had moved.
  bool undoMoves(const std::vector<Eigen::Index>& beyond, const Points& before) {
    const ClosestPointQuery query(cage_.vertices, cage_.triangles);
    bool any = false;
    for (const Eigen::Index p : beyond) {
      for (const int v : cage_.triangles.row(query.closest(points_.row(p)).triangle)) {
        any = any || cage_.vertices.row(v) != before.row(v);
        cage_.vertices.row(v) = before.row(v);
      }
    }
    return any;
  }

  Eigen::Vector3d vertex(int v) const { return cage_.vertices.row(v); }

  /// Where the vertex must be so that all points below the triangle stay behind its plane, which turns about
  /// the opposite edge: beyond the plane through that edge and the steepest point.
  std::optional<HalfSpace> bound(const Corner& corner, const Eigen::Vector3d& x) const {
    const Eigen::Vector3d a = vertex(corner.next), b = vertex(corner.last);
    const Eigen::Vector3d normal = (a - x).cross(b - x).normalized();
    const Eigen::Vector3d inward = normal.cross(b - a).normalized();  // in the plane, from the edge to x
    double highest = -1.0;
    std::optional<HalfSpace> found;
    for (const Eigen::Index p : below_[static_cast<std::size_t>(corner.triangle)]) {
      const Eigen::Vector3d offset = points_.row(p).transpose() - a;
      const double along = inward.dot(offset);
      if (along <= 0.0) continue;
      const double slope = normal.dot(offset) / offset.dot(inward);
      if (found && slope <= highest) continue;
      highest = slope;
      const Eigen::Vector3d plane = (normal - slope * inward).normalized();
      found = HalfSpace{plane, plane.dot(a) + margin_};
    }
    return found;
  }

  void moveVertex(Eigen::Index v) {
    const Eigen::Vector3d x = cage_.vertices.row(v);
    std::vector<HalfSpace> bounds;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Corner& corner : corners_[static_cast<std::size_t>(v)]) {
      if (const auto half_space = bound(corner, x)) bounds.push_back(*half_space);
      for (const Eigen::Index p : below_[static_cast<std::size_t>(corner.triangle)]) {
        sum += points_.row(p);
        ++count;
      }
    }
    if (count == 0) return;
    const std::optional<Eigen::Vector3d> target = nearestPointIn(bounds, sum / count, 0.1 * margin_);
    if (!target) return;
    for (const double share : {1.0, 0.5, 0.25}) {
      const Eigen::Vector3d moved = x + share * (*target - x);
      if (!keepsShape(v, moved)) continue;
      cage_.vertices.row(v) = moved;
      return;
    }
  }

  bool keepsShape(Eigen::Index v, const Eigen::Vector3d& moved) const {
    const Eigen::Vector3d x = cage_.vertices.row(v);
    for (const Corner& corner : corners_[static_cast<std::size_t>(v)]) {
      const Eigen::Vector3d a = vertex(corner.next), b = vertex(corner.last);
      const Eigen::Vector3d before = (a - x).cross(b - x), after = (a - moved).cross(b - moved);
      if (before.dot(after) < kMinMoveCosine * before.norm() * after.norm()) return false;
      const auto height = [&](const Eigen::Vector3d& tip, const Eigen::Vector3d& normal) {
        return normal.norm() /
               std::max({(a - tip).squaredNorm(), (b - tip).squaredNorm(), (b - a).squaredNorm()});
      };
      if (height(moved, after) < std::min(kMinFittedHeight, height(x, before))) return false;
    }
    return true;
  }

  TriangleMesh cage_;
  const Points& points_;
  const double margin_;
  std::vector<std::vector<Corner>> corners_;      ///< of each vertex
  std::vector<std::vector<Eigen::Index>> below_;  ///< points of each triangle
};

}  // namespace

std::vector<Eigen::Index> pointsBeyond(const Points& points, const TriangleMesh& mesh) {
  constexpr Eigen::Index kAtOnce = 1024;  // points: all weights of a large mesh do not fit
  const MeanValueCage cage(mesh.vertices, mesh.triangles);
  std::vector<Eigen::Index> beyond;
  WeightRows weights;
  for (Eigen::Index first = 0; first < points.rows(); first += kAtOnce) {
    const Eigen::Index count = std::min(kAtOnce, points.rows() - first);
    const std::vector<int> turns = cage.coordinates(points.middleRows(first, count), &weights);
    for (Eigen::Index p = 0; p < count; ++p) {
      if (turns[static_cast<std::size_t>(p)] == 0) beyond.push_back(first + p);
    }
  }
  return beyond;
}

TriangleMesh fitCage(const TriangleMesh& cage, const Points& points) {
  TriangleMesh fitted = cage;
  CageFitter fitter(cage, points);
  for (int k = 0; k < kSweeps; ++k) {
    const TriangleMesh next = fitter.sweep();
    if (intersectsItself(next)) break;
    const double gain = 1.0 - enclosedVolume(next.vertices, next.triangles) /
                                  enclosedVolume(fitted.vertices, fitted.triangles);
    fitted = next;
    if (gain < kMinGain) break;
  }
  return fitted;
}

}  // namespace softbody
