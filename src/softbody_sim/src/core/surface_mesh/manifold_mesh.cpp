#include "surface_mesh/manifold_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace softbody {
namespace {

constexpr double kSameAngle = 1e-6;  ///< between coincident triangles [rad], well above rounding

/// The half-edges by their start vertices; those of vertex v begin at first[v].
struct OutgoingHalfEdges {
  std::vector<int> first, half_edges;

  OutgoingHalfEdges(const TriangleList& triangles, std::size_t vertex_count) : first(vertex_count + 1, 0) {
    const int count = 3 * static_cast<int>(triangles.size());
    for (int h = 0; h < count; ++h) ++first[startOf(triangles, h)];
    std::partial_sum(first.begin(), first.end(), first.begin());
    half_edges.resize(static_cast<std::size_t>(count));
    for (int h = count - 1; h >= 0; --h) half_edges[--first[startOf(triangles, h)]] = h;
  }

  /// Number of half-edges from start to end; `last` is set to the last one.
  int count(const TriangleList& triangles, int start, int end, int* last) const {
    int found = 0;
    for (int k = first[start]; k < first[start + 1]; ++k) {
      if (endOf(triangles, half_edges[k]) != end) continue;
      ++found;
      *last = half_edges[k];
    }
    return found;
  }

  std::vector<int> between(const TriangleList& triangles, int start, int end) const {
    std::vector<int> found;
    for (int k = first[start]; k < first[start + 1]; ++k) {
      if (endOf(triangles, half_edges[k]) == end) found.push_back(half_edges[k]);
    }
    return found;
  }
};

/// A half-edge of a non-manifold edge, with the angle of its triangle around the edge.
struct Spoke {
  double angle;
  int half_edge;
  bool forward;  ///< along the axis: the body lies towards smaller angles
};

/// Where triangles coincide, the body before them ends before the next one begins: no body is without
/// thickness.
void closeBeforeOpening(std::vector<Spoke>* spokes) {
  const auto differ = [](const Spoke& a, const Spoke& b) { return b.angle - a.angle > kSameAngle; };
  // An angle near -pi may coincide with one near pi.
  for (std::size_t k = 0; k < spokes->size() && spokes->back().angle + kSameAngle > M_PI &&
                          spokes->front().angle - kSameAngle < spokes->back().angle - 2.0 * M_PI;
       ++k) {
    spokes->back().angle -= 2.0 * M_PI;
    std::rotate(spokes->rbegin(), spokes->rbegin() + 1, spokes->rend());
  }
  for (auto first = spokes->begin(); first != spokes->end();) {
    const auto last = std::adjacent_find(first, spokes->end(), differ);
    const auto end = last == spokes->end() ? last : last + 1;
    std::stable_partition(first, end, [](const Spoke& spoke) { return spoke.forward; });
    first = end;
  }
}

std::vector<Spoke> spokesOf(const TriangleList& triangles, const Points& vertices,
                            const std::vector<int>& forward, const std::vector<int>& backward) {
  const Eigen::Vector3d origin = vertices.row(startOf(triangles, forward.front()));
  const Eigen::Vector3d axis = vertices.row(endOf(triangles, forward.front())).transpose() - origin;
  const Eigen::Vector3d x = axis.unitOrthogonal(), y = axis.normalized().cross(x);
  std::vector<Spoke> spokes;
  const auto add = [&](int h, bool is_forward) {
    const Eigen::Vector3d apex = vertices.row(startOf(triangles, previousHalfEdge(h))).transpose() - origin;
    spokes.push_back({std::atan2(apex.dot(y), apex.dot(x)), h, is_forward});
  };
  for (const int h : forward) add(h, true);
  for (const int h : backward) add(h, false);
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
  closeBeforeOpening(&spokes);
  return spokes;
}

/// Pairs each backward half-edge with the forward one on the other side of the body, like brackets.
void pairSpokes(const std::vector<Spoke>& spokes, std::vector<int>* mates) {
  std::vector<int> open;
  for (std::size_t turn = 0; turn < 2 * spokes.size(); ++turn) {
    const Spoke& spoke = spokes[turn % spokes.size()];
    if ((*mates)[spoke.half_edge] >= 0) continue;
    if (!spoke.forward) {
      if (turn < spokes.size()) open.push_back(spoke.half_edge);
    } else if (!open.empty()) {
      (*mates)[spoke.half_edge] = open.back();
      (*mates)[open.back()] = spoke.half_edge;
      open.pop_back();
    }
  }
}

/// @throw std::invalid_argument that names the edge of a half-edge without a mate.
void requireMates(const TriangleList& triangles, const std::vector<int>& mates) {
  const auto lone = std::find(mates.begin(), mates.end(), -1);
  if (lone == mates.end()) return;
  const int h = static_cast<int>(lone - mates.begin()), start = startOf(triangles, h),
            end = endOf(triangles, h);
  int forward = 0, backward = 0;
  for (int other = 0; other < static_cast<int>(mates.size()); ++other) {
    forward += startOf(triangles, other) == start && endOf(triangles, other) == end ? 1 : 0;
    backward += startOf(triangles, other) == end && endOf(triangles, other) == start ? 1 : 0;
  }
  throw std::invalid_argument(
      fmt::format("the mesh is not a closed oriented surface: the edge from vertex {} to {} has {} triangles "
                  "in this direction and {} in the other",
                  start, end, forward, backward));
}

}  // namespace

std::vector<int> matesAcrossBody(const TriangleList& triangles, const Points& vertices) {
  const OutgoingHalfEdges outgoing(triangles, static_cast<std::size_t>(vertices.rows()));
  std::vector<int> mates(3 * triangles.size(), -1);
  for (int h = 0; h < static_cast<int>(mates.size()); ++h) {
    if (mates[h] >= 0) continue;
    const int start = startOf(triangles, h), end = endOf(triangles, h);
    int last = h, mate = -1;
    const int forward = outgoing.count(triangles, start, end, &last),
              backward = outgoing.count(triangles, end, start, &mate);
    if (forward != backward) continue;
    if (forward == 1) {
      mates[h] = mate;
      mates[mate] = h;
    } else {
      pairSpokes(spokesOf(triangles, vertices, outgoing.between(triangles, start, end),
                          outgoing.between(triangles, end, start)),
                 &mates);
    }
  }
  return mates;
}

ManifoldMesh splitNonManifold(const TriangleList& triangles, const Points& vertices) {
  ManifoldMesh manifold{triangles, matesAcrossBody(triangles, vertices), {}};
  requireMates(triangles, manifold.mates);
  const auto count = static_cast<int>(vertices.rows());
  std::vector<bool> taken(static_cast<std::size_t>(count), false), numbered(manifold.mates.size(), false);
  for (int corner = 0; corner < static_cast<int>(numbered.size()); ++corner) {
    if (numbered[corner]) continue;
    const int vertex = startOf(triangles, corner);
    int number = vertex;
    if (taken[vertex]) {
      number = count + static_cast<int>(manifold.copied_from.size());
      manifold.copied_from.push_back(vertex);
    }
    taken[vertex] = true;
    for (int h = corner; !numbered[h]; h = manifold.mates[previousHalfEdge(h)]) {
      numbered[h] = true;
      manifold.triangles[h / 3][h % 3] = number;
    }
  }
  return manifold;
}

}  // namespace softbody
