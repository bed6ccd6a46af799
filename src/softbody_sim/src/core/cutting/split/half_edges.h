#pragma once

#include <array>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Triangles as a growing list; half-edge 3 t + k of triangle t runs from its corner k to corner k + 1.
using TriangleList = std::vector<std::array<int, 3>>;

inline int nextHalfEdge(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline int previousHalfEdge(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
inline int startOf(const TriangleList& triangles, int h) { return triangles[h / 3][h % 3]; }
inline int endOf(const TriangleList& triangles, int h) { return startOf(triangles, nextHalfEdge(h)); }

TriangleList listOf(const Triangles& triangles);

/// Per half-edge the opposite one, which runs through the same edge the other way.
/// @throw std::invalid_argument if the triangles are not closed, oriented and two at every edge.
std::vector<int> halfEdgeMates(const TriangleList& triangles, int vertex_count);

/// Makes mates of those among the half-edges that run between the same vertices; there are two of each.
void pairHalfEdges(const TriangleList& triangles, const std::vector<int>& half_edges,
                   std::vector<int>* mates);

}  // namespace softbody
