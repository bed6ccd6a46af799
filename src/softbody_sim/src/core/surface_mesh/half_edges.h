#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A list of triangles that can grow. Half-edge 3 t + k of triangle t runs from its corner k to corner k + 1.
using TriangleList = std::vector<std::array<int, 3>>;

inline int nextHalfEdge(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline int previousHalfEdge(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
inline int startOf(const TriangleList& triangles, int h) { return triangles[h / 3][h % 3]; }
inline int endOf(const TriangleList& triangles, int h) { return startOf(triangles, nextHalfEdge(h)); }

TriangleList listOf(const Triangles& triangles);

/// Pairs half-edges between the same vertices. Each edge occurs exactly twice.
void pairHalfEdges(const TriangleList& triangles, const std::vector<int>& half_edges,
                   std::vector<int>* mates);

}  // namespace softbody
