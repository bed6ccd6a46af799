#pragma once

#include "cutting/split/split_surface.h"

namespace softbody {

/// Moves the curve of a cut to vertices and edges of the mesh that are within a distance. This avoids needles
/// and slivers beside it.
/// @param distance: smallest length of a new edge [m]; new triangles are at least half as high.
void snapCurve(double distance, SplitSurface* surface);

/// Splits each segment of the curve that has no neighbour at either end, because a slit needs a vertex that
/// can open.
void splitLoneSegments(SplitSurface* surface);

/// The smallest of a triangle's three heights.
double smallestHeight(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace softbody
