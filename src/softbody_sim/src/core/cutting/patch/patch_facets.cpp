#include "cutting/patch/patch_facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace softbody {
namespace {

constexpr double kSteepestFacet = 0.9;  // cosine between the normals of triangles in one facet

Eigen::Vector3d corner(const CutPatch& patch, int triangle, int k) {
  return patch.vertices.row(patch.triangles(triangle, k));
}

Eigen::Vector3d areaVector(const CutPatch& patch, int triangle) {
  const Eigen::Vector3d origin = corner(patch, triangle, 0);
  return 0.5 * (corner(patch, triangle, 1) - origin).cross(corner(patch, triangle, 2) - origin);
}

/// Welds vertices with equal coordinates: there the patches of one stroke meet.
CutPatch welded(const CutPatch& patch) {
  std::map<std::tuple<double, double, double>, int> numbers;
  CutPatch result{patch.vertices, Triangles(patch.triangles.rows(), 3)};
  std::vector<int> number(static_cast<std::size_t>(patch.vertices.rows()));
  for (Eigen::Index v = 0; v < patch.vertices.rows(); ++v) {
    const auto key = std::make_tuple(patch.vertices(v, 0), patch.vertices(v, 1), patch.vertices(v, 2));
    number[v] = numbers.emplace(key, static_cast<int>(v)).first->second;
  }
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < patch.triangles.rows(); ++t) {
    result.triangles.row(kept) = patch.triangles.row(t).unaryExpr([&number](int v) { return number[v]; });
    if (areaVector(result, static_cast<int>(kept)).norm() > 0.0) ++kept;
  }
  result.triangles.conservativeResize(kept, Eigen::NoChange);
  return result;
}

void findEdges(PatchFacets* facets) {
  std::map<std::pair<int, int>, int> numbers;
  const Triangles& triangles = facets->patch.triangles;
  facets->triangle_edges.resize(static_cast<std::size_t>(triangles.rows()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int start = triangles(t, k), end = triangles(t, (k + 1) % 3);
      const auto [entry, is_new] =
          numbers.emplace(std::minmax(start, end), static_cast<int>(facets->edges.size()));
      if (is_new) {
        facets->edges.push_back({start, end, t, -1, true});
      } else if (PatchEdge& edge = facets->edges[entry->second]; edge.right < 0 && edge.first == end) {
        edge.right = t;
      } else {
        throw std::invalid_argument(fmt::format(
            "the cut patch is not an oriented surface at the edge of its vertices {} and {}", start, end));
      }
      facets->triangle_edges[t][k] = entry->second;
    }
  }
}

PlaneFrame frameOf(const CutPatch& patch, int triangle) {
  const Eigen::Vector3d origin = corner(patch, triangle, 0);
  const Eigen::Vector3d x = (corner(patch, triangle, 1) - origin).normalized();
  return {origin, x, areaVector(patch, triangle).normalized().cross(x)};
}

bool fits(const PatchFacets& facets, int triangle, const PlaneFrame& frame, double flatness) {
  const Eigen::Vector3d normal = frame.x_axis.cross(frame.y_axis);
  if (normal.dot(areaVector(facets.patch, triangle).normalized()) < kSteepestFacet) return false;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(normal.dot(corner(facets.patch, triangle, k) - frame.origin)) > flatness) return false;
  }
  return true;
}

/// Grows a facet from a triangle over all connected triangles that lie in its plane.
void growFacet(int first, double flatness, PatchFacets* facets) {
  const int facet = static_cast<int>(facets->frames.size());
  facets->frames.push_back(frameOf(facets->patch, first));
  facets->facets[first] = facet;
  std::vector<int> open{first};
  while (!open.empty()) {
    const int triangle = open.back();
    open.pop_back();
    for (const int e : facets->triangle_edges[triangle]) {
      const PatchEdge& edge = facets->edges[e];
      const int neighbour = edge.left == triangle ? edge.right : edge.left;
      if (neighbour < 0 || facets->facets[neighbour] >= 0) continue;
      if (!fits(*facets, neighbour, facets->frames[facet], flatness)) continue;
      facets->facets[neighbour] = facet;
      open.push_back(neighbour);
    }
  }
}

}  // namespace

PatchFacets facetsOf(const CutPatch& patch, double flatness) {
  PatchFacets facets;
  facets.patch = welded(patch);
  findEdges(&facets);
  // The largest triangle first: its plane is the most accurate.
  const auto count = static_cast<std::size_t>(facets.patch.triangles.rows());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> areas(count);
  for (std::size_t t = 0; t < count; ++t) areas[t] = areaVector(facets.patch, static_cast<int>(t)).norm();
  std::stable_sort(order.begin(), order.end(), [&areas](int a, int b) { return areas[a] > areas[b]; });
  facets.facets.assign(count, -1);
  for (const int t : order) {
    if (facets.facets[t] < 0) growFacet(t, flatness, &facets);
  }
  for (PatchEdge& edge : facets.edges) {
    edge.fold = edge.right < 0 || facets.facets[edge.left] != facets.facets[edge.right];
  }
  return facets;
}

}  // namespace softbody
