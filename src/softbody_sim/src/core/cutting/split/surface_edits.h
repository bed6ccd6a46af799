#pragma once

#include "cutting/split/split_surface.h"

/// Edits of a split surface that keep it a closed manifold.
namespace softbody {

/// Merges the half-edge's start into its end. Where two pieces of the curve come to lie on each other,
/// opposite ones cancel.
/// @return false, and nothing is changed, if the surface would no longer be a manifold.
bool collapseEdge(int half_edge, SplitSurface* surface);

/// Moves an edge, and the curve along it, to the third corner of the half-edge's triangle, which has hardly
/// any height: the corner then lies on the edge. @param along: where on the half-edge, 0..1. @return false,
/// and nothing is changed, if that cannot be.
bool bendEdgeToApex(int half_edge, double along, SplitSurface* surface);

/// Inserts a vertex in the middle of an edge.
void splitEdge(int half_edge, SplitSurface* surface);

}  // namespace softbody
