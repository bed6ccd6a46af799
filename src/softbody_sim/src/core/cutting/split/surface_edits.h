#pragma once

#include "cutting/split/split_surface.h"

/// Edits of a split surface that keep it a closed manifold.
namespace softbody {

/// Merges the start of the half-edge into its end. Opposite segments of the curve that coincide then cancel.
/// @return false, without any change, if the surface would not stay a manifold.
bool collapseEdge(int half_edge, SplitSurface* surface);

/// Flips the edge of a very flat triangle: the edge, and the curve along it, bends to the third corner.
/// @param along: position of that corner on the half-edge, 0..1. @return false, without any change, if that
/// is impossible.
bool bendEdgeToApex(int half_edge, double along, SplitSurface* surface);

/// Inserts a vertex in the middle of an edge.
void splitEdge(int half_edge, SplitSurface* surface);

}  // namespace softbody
