#include "cutting/patch/plane_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace softbody {
namespace {

using Edge = std::array<int, 2>;  // two numbers in ascending order

Edge edgeBetween(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class Section {
 public:
  Section(const TetTopology& volume, const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
      : volume_(volume),
        x_(normal.unitOrthogonal()),
        y_(normal.normalized().cross(x_)),
        heights_(volume.rest_vertices.rows()) {
    // One by one: in a matrix product, coincident vertices could differ in their last digit.
    for (Eigen::Index v = 0; v < heights_.size(); ++v)
      heights_[v] = normal.dot(volume.rest_vertices.row(v).transpose() - point);
  }

  void cutThrough(int first, const std::vector<bool>& wanted);
  void extend(double overhang);
  CutPatch patch() const;

 private:
  /// The intersections of the plane with the edges of a tet, counter-clockwise.
  struct Polygon {
    std::vector<int> points;
    bool taken = false;
  };
  bool isAbove(int vertex) const { return heights_[vertex] >= 0.0; }
  int pointOn(int a, int b);
  Polygon polygonOf(Eigen::Index tet);
  Eigen::Vector2d inPlane(int point) const { return {x_.dot(points_[point]), y_.dot(points_[point])}; }
  Eigen::Vector3d outwardOf(int from, int to) const;
  template <class Visit>
  static void forEachSide(const Polygon& polygon, const Visit& visit) {
    for (std::size_t k = 0; k < polygon.points.size(); ++k)
      visit(polygon.points[k], polygon.points[(k + 1) % polygon.points.size()]);
  }

  const TetTopology& volume_;
  Eigen::Vector3d x_, y_;
  Eigen::VectorXd heights_;
  std::vector<Polygon> polygons_;                 ///< per tet
  std::map<Edge, std::vector<int>> sides_;        ///< between two points -> tets
  std::map<std::array<double, 3>, int> numbers_;  ///< of the points
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

/// The two walls of an earlier cut coincide at rest and share their points: the section continues across
/// them.
int Section::pointOn(int a, int b) {
  Eigen::RowVector3d low = volume_.rest_vertices.row(a), high = volume_.rest_vertices.row(b);
  if (std::lexicographical_compare(high.data(), high.data() + 3, low.data(), low.data() + 3)) {
    std::swap(a, b);
    std::swap(low, high);
  }
  const double t = heights_[a] / (heights_[a] - heights_[b]);
  const Eigen::Vector3d point = (1.0 - t) * low + t * high;
  const auto [entry, is_new] =
      numbers_.try_emplace({point.x(), point.y(), point.z()}, static_cast<int>(points_.size()));
  if (is_new) points_.push_back(point);
  return entry->second;
}

Section::Polygon Section::polygonOf(Eigen::Index tet) {
  Polygon polygon;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const int a = volume_.tets(tet, i), b = volume_.tets(tet, j);
      if (isAbove(a) == isAbove(b)) continue;
      polygon.points.push_back(pointOn(a, b));
      center += inPlane(polygon.points.back());
    }
  }
  if (polygon.points.empty()) return polygon;
  center /= static_cast<double>(polygon.points.size());
  const auto angleOf = [&](int point) {
    const Eigen::Vector2d arm = inPlane(point) - center;
    return std::atan2(arm.y(), arm.x());
  };
  std::sort(polygon.points.begin(), polygon.points.end(),
            [&](int p, int q) { return angleOf(p) < angleOf(q); });
  return polygon;
}

void Section::cutThrough(int first, const std::vector<bool>& wanted) {
  for (Eigen::Index t = 0; t < volume_.tets.rows(); ++t) {
    polygons_.push_back(polygonOf(t));
    forEachSide(polygons_.back(),
                [&](int p, int q) { sides_[edgeBetween(p, q)].push_back(static_cast<int>(t)); });
  }
  std::vector<int> open{first};
  polygons_[first].taken = true;
  while (!open.empty()) {
    const Polygon& polygon = polygons_[open.back()];
    open.pop_back();
    for (std::size_t k = 1; k + 1 < polygon.points.size(); ++k)
      triangles_.push_back({polygon.points[0], polygon.points[k], polygon.points[k + 1]});
    forEachSide(polygon, [&](int p, int q) {
      for (const int neighbour : sides_[edgeBetween(p, q)]) {
        if (polygons_[neighbour].taken || !wanted[neighbour]) continue;
        polygons_[neighbour].taken = true;
        open.push_back(neighbour);
      }
    });
  }
}

/// The normal of a polygon's side in the plane, outward.
Eigen::Vector3d Section::outwardOf(int from, int to) const {
  const Eigen::Vector2d along = (inPlane(to) - inPlane(from)).normalized();
  return along.y() * x_ - along.x() * y_;
}

void Section::extend(double overhang) {
  std::vector<Edge> border;  // directed, counter-clockwise
  std::map<int, Eigen::Vector3d> outward;
  for (const Polygon& polygon : polygons_) {
    if (!polygon.taken) continue;
    forEachSide(polygon, [&](int p, int q) {
      if (sides_[edgeBetween(p, q)].size() != 1) return;
      border.push_back({p, q});
      for (const int point : {p, q})
        outward.try_emplace(point, Eigen::Vector3d::Zero()).first->second += outwardOf(p, q);
    });
  }
  std::map<int, int> beyond;
  for (const auto& [point, direction] : outward) {
    if (direction.norm() < 1e-6) continue;  // the border folds back on itself here
    beyond[point] = static_cast<int>(points_.size());
    points_.push_back(points_[point] + overhang * direction.normalized());
  }
  for (const auto& [p, q] : border) {
    if (beyond.count(p) == 0 || beyond.count(q) == 0) continue;
    triangles_.push_back({q, p, beyond[p]});
    triangles_.push_back({q, beyond[p], beyond[q]});
  }
}

CutPatch Section::patch() const {
  CutPatch patch;
  std::vector<int> numbers(points_.size(), -1);
  int count = 0;
  patch.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
  patch.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int point = triangles_[t][k];
      if (numbers[point] < 0) {
        patch.vertices.row(count) = points_[point];
        numbers[point] = count++;
      }
      patch.triangles(static_cast<Eigen::Index>(t), k) = numbers[point];
    }
  }
  patch.vertices.conservativeResize(count, Eigen::NoChange);
  return patch;
}

}  // namespace

CutPatch planeSection(const TetTopology& volume, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                      int first, const std::vector<bool>& wanted, double overhang) {
  Section section(volume, point, normal);
  section.cutThrough(first, wanted);
  section.extend(overhang);
  return section.patch();
}

}  // namespace softbody
