#include "constraints/contact_detection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A point on the surface: vertices with weights in units of 1/n. Vertices without weight are left out.
using LatticePlace = std::vector<std::pair<int, int>>;

LatticePlace latticePlace(const Triangles& triangles, Eigen::Index triangle,
                          const std::array<int, 3>& weights) {
  LatticePlace place;
  for (int k = 0; k < 3; ++k) {
    if (weights[k] > 0) place.emplace_back(triangles(triangle, k), weights[k]);
  }
  std::sort(place.begin(), place.end());
  return place;
}

/// The lattice triangles of one surface triangle, each with its three corners.
std::vector<std::array<std::array<int, 3>, 3>> latticeTriangles(int n) {
  std::vector<std::array<std::array<int, 3>, 3>> triangles;
  const auto at = [n](int i, int j) { return std::array<int, 3>{n - i - j, i, j}; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

double longestEdge(const Points& vertices, const Triangles& triangles) {
  double longest = 0.0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      longest =
          std::max(longest, (vertices.row(triangles(f, k)) - vertices.row(triangles(f, (k + 1) % 3))).norm());
  }
  return longest;
}

double triangleArea(const Points& vertices, const Triangles& triangles, Eigen::Index f) {
  const Eigen::RowVector3d a = vertices.row(triangles(f, 0));
  return 0.5 * (vertices.row(triangles(f, 1)) - a).cross(vertices.row(triangles(f, 2)) - a).norm();
}

/// The tet of each surface triangle; the key is the triangle's sorted vertices.
std::map<std::array<int, 3>, int> tetsOfFaces(const Tets& tets) {
  std::map<std::array<int, 3>, int> owners;
  for (int t = 0; t < tets.rows(); ++t) {
    for (int left_out = 0; left_out < 4; ++left_out) {
      std::array<int, 3> face{};
      for (int k = 0, next = 0; k < 4; ++k) {
        if (k != left_out) face[next++] = tets(t, k);
      }
      std::sort(face.begin(), face.end());
      owners[face] = t;
    }
  }
  return owners;
}

MaterialPoint materialPoint(const LatticePlace& place, int n, int tet, const Tets& tets) {
  MaterialPoint point{tet, Eigen::Vector4d::Zero()};
  for (const auto& [vertex, weight] : place) {
    for (int k = 0; k < 4; ++k) {
      if (tets(tet, k) == vertex) point.barycentric[k] = static_cast<double>(weight) / n;
    }
  }
  return point;
}

/// First point on the path from a to b, in the obstacle's frame, that touches it (sphere tracing). Gives b if
/// the path does not touch it, and a if the path starts inside.
Eigen::Vector3d firstMeeting(const Obstacle& obstacle, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr int kMaxSteps = 100;      // along a surface, each is short
  constexpr double kTouching = 1e-7;  // [m]
  const double length = (b - a).norm();
  if (length == 0.0) return b;
  const Eigen::Vector3d direction = (b - a) / length;
  double way = 0.0;
  for (int step = 0; step < kMaxSteps && way < length; ++step) {
    const double distance = distanceTo(obstacle, a + way * direction).distance;
    if (distance < kTouching) return a + way * direction;
    way += distance;
  }
  return b;
}

/// The place whose tangent plane stops a point on its path from a to b, with the surface there: b, unless b
/// has left the obstacle again or is nearer to another side of it; then the first meeting.
std::pair<Eigen::Vector3d, SurfaceDistance> touchedPlace(const Obstacle& obstacle, const Eigen::Vector3d& a,
                                                         const Eigen::Vector3d& b, double reach_m) {
  const SurfaceDistance end = distanceTo(obstacle, b);
  const Eigen::Vector3d meeting = firstMeeting(obstacle, a, b);
  if (meeting == b) return {b, end};
  const SurfaceDistance surface = distanceTo(obstacle, meeting);
  if (end.distance <= reach_m && surface.normal.dot(end.normal) > 0.0) return {b, end};
  return {meeting, surface};
}

}  // namespace

std::vector<int> tetsOfSurface(const TetTopology& topology) {
  const std::map<std::array<int, 3>, int> owners = tetsOfFaces(topology.tets);
  std::vector<int> tets;
  for (Eigen::Index f = 0; f < topology.surface.rows(); ++f) {
    std::array<int, 3> face{topology.surface(f, 0), topology.surface(f, 1), topology.surface(f, 2)};
    std::sort(face.begin(), face.end());
    tets.push_back(owners.at(face));
  }
  return tets;
}

std::vector<ContactPoint> sampleContactPoints(const TetTopology& topology, double spacing_m) {
  const double edge = longestEdge(topology.rest_vertices, topology.surface);
  const int n = std::clamp(static_cast<int>(std::ceil(edge / spacing_m)), 1, 8);
  const auto lattice = latticeTriangles(n);
  const std::vector<int> tets = tetsOfSurface(topology);
  std::map<LatticePlace, ContactPoint> points;
  for (Eigen::Index f = 0; f < topology.surface.rows(); ++f) {
    const int tet = tets[static_cast<std::size_t>(f)];
    const double share = triangleArea(topology.rest_vertices, topology.surface, f) / (3.0 * n * n);
    for (const auto& triangle : lattice) {
      for (const std::array<int, 3>& corner : triangle) {
        const LatticePlace place = latticePlace(topology.surface, f, corner);
        ContactPoint& point = points[place];
        if (point.place.tet < 0) point.place = materialPoint(place, n, tet, topology.tets);
        point.area += share;
      }
    }
  }
  std::vector<ContactPoint> result;
  result.reserve(points.size());
  for (const auto& entry : points) result.push_back(entry.second);
  return result;
}

void findContacts(const std::vector<ContactPoint>& points, const Tets& tets, const Points& before,
                  const Points& after, const std::vector<Obstacle>& obstacles,
                  const std::vector<Eigen::Isometry3d>& before_poses, double reach_m,
                  std::vector<Contact>* contacts) {
  contacts->clear();
  if (!obstacles.empty()) contacts->reserve(points.size());
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const Obstacle& obstacle = obstacles[o];
    const Eigen::Isometry3d to_obstacle = obstacle.pose.inverse(), to_earlier = before_poses[o].inverse();
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Vector3d start = to_earlier * positionOf(points[p].place, before, tets);
      const Eigen::Vector3d end = to_obstacle * positionOf(points[p].place, after, tets);
      const double start_distance = distanceTo(obstacle, start).distance;
      if (start_distance > reach_m + (end - start).norm()) continue;  // it cannot come near
      const auto [meeting, surface] = touchedPlace(obstacle, start, end, reach_m);
      if (surface.distance > reach_m) continue;
      contacts->push_back({static_cast<int>(p), static_cast<int>(o),
                           obstacle.pose * (meeting - surface.distance * surface.normal),
                           obstacle.pose.linear() * surface.normal, obstacle.pose * start,
                           std::max(0.0, -start_distance), obstacle.friction});
    }
  }
}

bool isOrderedBefore(const Contact& a, const Contact& b) {
  return std::tie(a.obstacle, a.point) < std::tie(b.obstacle, b.point);
}

void keepEarlierContacts(const std::vector<Contact>& earlier, std::vector<Contact>* contacts) {
  const auto found = static_cast<std::ptrdiff_t>(contacts->size());
  for (const Contact& contact : earlier) {
    const auto begin = contacts->begin();
    const auto place = std::lower_bound(begin, begin + found, contact, isOrderedBefore);
    if (place == begin + found || isOrderedBefore(contact, *place)) {
      contacts->push_back(contact);
    } else {
      place->lift = contact.lift;
      place->depth = contact.depth;
    }
  }
  std::sort(contacts->begin(), contacts->end(), isOrderedBefore);
}

}  // namespace softbody
