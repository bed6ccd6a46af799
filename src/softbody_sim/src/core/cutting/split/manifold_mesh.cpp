#include "cutting/split/manifold_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace softbody {
namespace {

/// The half-edges by their starts; those of vertex v begin at first[v].
struct Arrows {
  std::vector<int> first, half_edges;

  Arrows(const TriangleList& triangles, std::size_t vertex_count) : first(vertex_count + 1, 0) {
    const int count = 3 * static_cast<int>(triangles.size());
    for (int h = 0; h < count; ++h) ++first[startOf(triangles, h)];
    std::partial_sum(first.begin(), first.end(), first.begin());
    half_edges.resize(static_cast<std::size_t>(count));
    for (int h = count - 1; h >= 0; --h) half_edges[--first[startOf(triangles, h)]] = h;
  }

  /// How many half-edges run from start to end, and the last of them.
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

/// A half-edge at a crowded edge, by the angle of its triangle round the edge.
struct Spoke {
  double angle;
  int half_edge;
  bool forward;  ///< from the edge's lower vertex: the body lies towards smaller angles
};

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
  return spokes;
}

/// Pairs each backward half-edge with the forward one where the body behind it ends, like brackets.
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

std::vector<int> pairAll(const TriangleList& triangles, const Points& vertices) {
  const Arrows arrows(triangles, static_cast<std::size_t>(vertices.rows()));
  std::vector<int> mates(3 * triangles.size(), -1);
  for (int h = 0; h < static_cast<int>(mates.size()); ++h) {
    if (mates[h] >= 0) continue;
    const int start = startOf(triangles, h), end = endOf(triangles, h);
    int last = h, mate = -1;
    const int forward = arrows.count(triangles, start, end, &last),
              backward = arrows.count(triangles, end, start, &mate);
    if (forward != backward) {
      throw std::invalid_argument(fmt::format(
          "the mesh is not a closed oriented surface: the edge from vertex {} to {} has {} triangles to one "
          "side and {} to the other",
          start, end, forward, backward));
    }
    if (forward == 1) {
      mates[h] = mate;
      mates[mate] = h;
    } else {
      pairSpokes(spokesOf(triangles, vertices, arrows.between(triangles, start, end),
                          arrows.between(triangles, end, start)),
                 &mates);
    }
  }
  return mates;
}

}  // namespace

ManifoldMesh splitNonManifold(const TriangleList& triangles, const Points& vertices) {
  ManifoldMesh manifold{triangles, pairAll(triangles, vertices), {}};
  const auto count = static_cast<int>(vertices.rows());
  std::vector<bool> taken(static_cast<std::size_t>(count), false), named(manifold.mates.size(), false);
  for (int corner = 0; corner < static_cast<int>(named.size()); ++corner) {
    if (named[corner]) continue;
    const int vertex = startOf(triangles, corner);
    int name = vertex;
    if (taken[vertex]) {
      name = count + static_cast<int>(manifold.copied_from.size());
      manifold.copied_from.push_back(vertex);
    }
    taken[vertex] = true;
    for (int h = corner; !named[h]; h = manifold.mates[previousHalfEdge(h)]) {
      named[h] = true;
      manifold.triangles[h / 3][h % 3] = name;
    }
  }
  return manifold;
}

}  // namespace softbody
