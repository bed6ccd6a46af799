#pragma once

#include "cutting/split/split_surface.h"

namespace softbody {

/// Where the curve of a cut passes a vertex or an edge of the mesh within a distance, it is moved there: no
/// needles and slivers are left beside it.
/// @param distance: shortest new edge that is left [m]; a new triangle's height is at least half of it.
void snapCurve(double distance, SplitSurface* surface);

/// Splits the pieces of the curve that have no neighbour at either end: the slit needs a vertex that can
/// open.
void splitLonePieces(SplitSurface* surface);

/// The smallest of a triangle's three heights.
double smallestHeight(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace softbody
