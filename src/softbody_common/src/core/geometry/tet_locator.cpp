#include "softbody_common/geometry/tet_locator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kRoundingOfSquares = 1e-6;  // of a squared distance; slivers magnify rounding errors

/// Squared distance of a point outside of the tet. The nearest point is on a face that is opposite to a
/// corner with a negative coordinate.
double squaredDistanceToTet(const Eigen::Vector3d& p, const Eigen::Vector4d& barycentric,
                            const Points& vertices, const Tets& tets, int t) {
  static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::array<Eigen::Vector3d, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = vertices.row(tets(t, k));
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) {
    if (barycentric[k] >= 0.0) continue;
    const auto& face = kFaces[k];
    best = std::min(
        best, (nearestOnTriangle(p, corner[face[0]], corner[face[1]], corner[face[2]]) - p).squaredNorm());
  }
  return best;
}

}  // namespace

TetLocator::TetLocator(const Points& vertices, const Tets& tets) : vertices_(vertices), tets_(tets) {
  if (tets.rows() == 0) throw std::invalid_argument("TetLocator: the mesh has no tet");
  if (tets.minCoeff() < 0 || tets.maxCoeff() >= vertices.rows()) {
    throw std::invalid_argument("TetLocator: a tet has a vertex index that is out of range");
  }
  inverse_edges_.resize(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
      edges.col(k) = (vertices.row(tets(t, k + 1)) - vertices.row(tets(t, 0))).transpose();
    inverse_edges_[t] = edges.inverse();
    if (!inverse_edges_[t].allFinite()) {
      throw std::invalid_argument("TetLocator: tet " + std::to_string(t) + " has no volume");
    }
  }
  const Eigen::Vector3d low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  const Eigen::Vector3d extent = high - low;
  // About one tet per cell. The lower limit bounds the number of cells of a flat mesh.
  const double volume = std::max(extent.prod(), std::pow(0.1 * extent.maxCoeff(), 3));
  cell_size_ = std::max(std::cbrt(volume / static_cast<double>(tets.rows())), extent.maxCoeff() / 64.0);
  origin_ = low;
  cells_ = (extent / cell_size_).array().floor().cast<int>() + 1;
  grid_.resize(static_cast<std::size_t>(cells_.prod()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Eigen::Vector3d tet_low = vertices.row(tets(t, 0)), tet_high = tet_low;
    for (int k = 1; k < 4; ++k) {
      tet_low = tet_low.cwiseMin(vertices.row(tets(t, k)).transpose());
      tet_high = tet_high.cwiseMax(vertices.row(tets(t, k)).transpose());
    }
    const Eigen::Vector3i first = cellOf(tet_low), last = cellOf(tet_high);
    for (int x = first.x(); x <= last.x(); ++x) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int z = first.z(); z <= last.z(); ++z) {
          grid_[(x * cells_.y() + y) * cells_.z() + z].push_back(static_cast<int>(t));
        }
      }
    }
  }
}

Eigen::Vector3i TetLocator::cellOf(const Eigen::Vector3d& point) const {
  // Clamped before the cast, because a far point does not fit into an int.
  const Eigen::Array3d cell = ((point - origin_) / cell_size_).array().floor();
  return cell.max(0.0).min((cells_.array() - 1).cast<double>()).cast<int>();
}

const std::vector<int>& TetLocator::tetsIn(const Eigen::Vector3i& cell) const {
  return grid_[(cell.x() * cells_.y() + cell.y()) * cells_.z() + cell.z()];
}

Eigen::Vector4d TetLocator::barycentricIn(int tet, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d tail = inverse_edges_[tet] * (point - vertices_.row(tets_(tet, 0)).transpose());
  return {1.0 - tail.sum(), tail[0], tail[1], tail[2]};
}

bool TetLocator::contains(const Eigen::Vector3d& point) const {
  if (!point.allFinite()) throw std::invalid_argument("TetLocator: the point is not finite");
  const std::vector<int>& tets = tetsIn(cellOf(point));
  return std::any_of(tets.begin(), tets.end(),
                     [&](int tet) { return barycentricIn(tet, point).minCoeff() >= 0.0; });
}

/// A lower bound of the squared distance: to the farthest plane of the faces that are visible from the point.
double TetLocator::squaredDistanceToPlanes(int tet, const Eigen::Vector4d& barycentric) const {
  const Eigen::Matrix3d& gradients = inverse_edges_[tet];  // of the last three coordinates, in rows
  double most = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (barycentric[k] >= 0.0) continue;
    const double squared_gradient =
        k == 0 ? gradients.colwise().sum().squaredNorm() : gradients.row(k - 1).squaredNorm();
    most = std::max(most, barycentric[k] * barycentric[k] / squared_gradient);
  }
  return most;
}

void TetLocator::consider(const Eigen::Vector3d& point, int tet, Candidate* best) const {
  const Eigen::Vector4d barycentric = barycentricIn(tet, point);
  if (squaredDistanceToPlanes(tet, barycentric) > (1.0 + kRoundingOfSquares) * best->squared_distance) return;
  const double distance =
      barycentric.minCoeff() >= 0.0 ? 0.0 : squaredDistanceToTet(point, barycentric, vertices_, tets_, tet);
  if (distance < best->squared_distance || (distance == best->squared_distance && tet < best->tet)) {
    *best = {tet, distance, barycentric};
  }
}

/// Considers the cells at a distance of `ring` cells from the center (largest over the axes).
void TetLocator::considerRing(const Eigen::Vector3d& point, const Eigen::Vector3i& center, int ring,
                              Candidate* best) const {
  const Eigen::Vector3i first = (center.array() - ring).max(0);
  const Eigen::Vector3i last = (center.array() + ring).min(cells_.array() - 1);
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) {
      const bool on_side = std::abs(x - center.x()) == ring || std::abs(y - center.y()) == ring;
      // Inside of the ring's sides, only the two ends of the column belong to it.
      const int step = on_side || ring == 0 ? 1 : 2 * ring;
      for (int z = on_side ? first.z() : center.z() - ring; z <= last.z(); z += step) {
        if (z < first.z()) continue;
        for (int tet : tetsIn({x, y, z})) consider(point, tet, best);
      }
    }
  }
}

MaterialPoint TetLocator::locate(const Eigen::Vector3d& point) const {
  if (!point.allFinite()) throw std::invalid_argument("TetLocator: the point is not finite");
  Candidate best{-1, std::numeric_limits<double>::infinity(), Eigen::Vector4d::Zero()};
  const Eigen::Vector3i center = cellOf(point);
  for (const int tet : tetsIn(center)) {  // in ascending order of tets
    const Eigen::Vector4d barycentric = barycentricIn(tet, point);
    if (barycentric.minCoeff() >= 0.0) return {tet, barycentric};
  }
  const Eigen::Vector3d clamped =
      point.cwiseMax(origin_).cwiseMin(origin_ + cell_size_ * cells_.cast<double>());
  const int reach = cells_.maxCoeff();
  for (int ring = 0; ring <= reach; ++ring) {
    // Cells of this ring are at least (ring - 1) cells away from the clamped point.
    const double ring_distance = std::max(0, ring - 1) * cell_size_;
    if (best.tet >= 0 &&
        ring_distance * ring_distance + (point - clamped).squaredNorm() > best.squared_distance)
      break;
    considerRing(point, center, ring, &best);
  }
  return {best.tet, best.barycentric};
}

std::vector<MaterialPoint> bindPoints(const Points& points, const Points& vertices, const Tets& tets) {
  const TetLocator locator(vertices, tets);
  std::vector<MaterialPoint> places(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index p = 0; p < points.rows(); ++p) places[p] = locator.locate(points.row(p));
  return places;
}

Points applyBinding(const std::vector<MaterialPoint>& places, const Points& vertices, const Tets& tets) {
  Points points(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t p = 0; p < places.size(); ++p) {
    points.row(static_cast<Eigen::Index>(p)) = positionOf(places[p], vertices, tets);
  }
  return points;
}

}  // namespace softbody
