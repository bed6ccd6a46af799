#pragma once

#include "cutting/surface/wall_fill.h"

/// Edits of a fill that keep its outline.
namespace softbody {

/// Flips the longest edges of triangles that are lower than a limit [m], where that makes the lower one of
/// two higher: on a finely sampled rim the Delaunay triangulation cuts off ears that hardly have a height.
void raiseLowTriangles(double limit, const PatchFacets& facets, WallFill* fill);

/// Inserts a point in the middle of an edge between two triangles.
void splitFillEdge(int half_edge, WallFill* fill);

}  // namespace softbody
