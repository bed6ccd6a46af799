#pragma once

#include "cutting/fill/cut_fill.h"

/// Edits of a fill that keep its outline.
namespace softbody {

/// Flips the longest edges of triangles that are lower than a limit [m], if the lower one of the two
/// triangles becomes higher. On a finely sampled rim the Delaunay triangulation makes very flat triangles.
void raiseLowTriangles(double limit, const PatchFacets& facets, CutFill* fill);

/// Inserts a point in the middle of an edge between two triangles.
void splitFillEdge(int half_edge, CutFill* fill);

}  // namespace softbody
