#include "cutting/binding/surface_spots.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {
namespace {

// Relative to the diagonal of the surface.
constexpr double kFarthest = 1e-3;  // two surfaces, each within kRemeshDistance of the one before the cut
constexpr double kRounding = 1e-6;
constexpr int kCells = 32;  ///< of the grid, per axis

/// Points in the cells of a grid.
class PointGrid {
 public:
  PointGrid(const std::vector<int>& which, const Points& points) : points_(points) {
    for (const int v : which) box_.extend(points.row(v).transpose());
    cell_ = std::max(box_.sizes().maxCoeff() / kCells, std::numeric_limits<double>::min());
    first_.assign(kCells * kCells * kCells + 1, 0);
    for (const int v : which) ++first_[indexOf(cellOf(points.row(v)))];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    entries_.resize(which.size());
    for (const int v : which) entries_[--first_[indexOf(cellOf(points.row(v)))]] = v;
  }

  /// Calls visit(point) for the points in a box.
  template <class Visit>
  void forEachIn(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    if (!box.intersects(box_)) return;
    const Eigen::Vector3i low = cellOf(box.min()), high = cellOf(box.max());
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) {
        const int row = kCells * (kCells * x + y);
        for (int e = first_[row + low.z()]; e < first_[row + high.z() + 1]; ++e) {
          if (box.contains(points_.row(entries_[e]).transpose())) visit(entries_[e]);
        }
      }
    }
  }

 private:
  Eigen::Vector3i cellOf(const Eigen::Vector3d& point) const {
    return ((point - box_.min()) / cell_).array().floor().max(0.0).min(kCells - 1.0).matrix().cast<int>();
  }
  static std::size_t indexOf(const Eigen::Vector3i& cell) {
    return static_cast<std::size_t>(kCells * (kCells * cell.x() + cell.y()) + cell.z());
  }

  const Points& points_;
  Eigen::AlignedBox3d box_;
  double cell_ = 0.0;
  std::vector<int> first_, entries_;  ///< those of cell c begin at first_[c]
};

/// A position of a vertex on a triangle.
struct Spot {
  double away = std::numeric_limits<double>::infinity();  ///< from the triangle, at rest [m]
  Eigen::RowVector3d position;                            ///< in the other state
  double distance = 0.0;                                  ///< from the given position [m]

  bool isBetterThan(const Spot& other, double rounding) const {
    if (std::max(away, other.away) > std::min(away, other.away) + rounding) return away < other.away;
    return distance < other.distance;
  }
};

Spot spotOn(const MeshTopology& surface, const Points& shown, const Eigen::RowVector3i& triangle,
            const Eigen::RowVector3d& rest, const Eigen::RowVector3d& position) {
  const Eigen::RowVector3d origin = surface.rest_vertices.row(triangle[0]),
                           first = surface.rest_vertices.row(triangle[1]) - origin,
                           second = surface.rest_vertices.row(triangle[2]) - origin;
  const Eigen::RowVector3d normal = first.cross(second), place = rest - origin;
  const double area = std::max(normal.squaredNorm(), std::numeric_limits<double>::min());
  Eigen::Vector2d w(place.cross(second).dot(normal) / area, first.cross(place).dot(normal) / area);
  w = w.cwiseMax(0.0);
  if (w.sum() > 1.0) w /= w.sum();
  Spot spot;
  spot.away = (w[0] * first + w[1] * second - place).norm();
  spot.position = (1.0 - w.sum()) * shown.row(triangle[0]) + w[0] * shown.row(triangle[1]) +
                  w[1] * shown.row(triangle[2]);
  spot.distance = (spot.position - position).norm();
  return spot;
}

}  // namespace

void moveWithSurface(const MeshTopology& surface, const Points& shown, const std::vector<int>& which,
                     const Points& rest, Points* positions) {
  if (which.empty()) return;
  const Points& vertices = surface.rest_vertices;
  const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
  const PointGrid grid(which, rest);
  std::vector<Spot> spots(static_cast<std::size_t>(rest.rows()));
  for (const auto& triangle : surface.triangles.rowwise()) {
    Eigen::AlignedBox3d box;
    for (const int v : triangle) box.extend(vertices.row(v).transpose());
    box.min().array() -= kFarthest * diagonal;
    box.max().array() += kFarthest * diagonal;
    grid.forEachIn(box, [&](int v) {
      const Spot spot = spotOn(surface, shown, triangle, rest.row(v), positions->row(v));
      Spot& best = spots[static_cast<std::size_t>(v)];
      if (spot.away <= kFarthest * diagonal && spot.isBetterThan(best, kRounding * diagonal)) best = spot;
    });
  }
  for (const int v : which) {
    const Spot& spot = spots[static_cast<std::size_t>(v)];
    if (std::isfinite(spot.away)) positions->row(v) = spot.position;
  }
}

}  // namespace softbody
