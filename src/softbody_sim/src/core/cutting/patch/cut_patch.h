#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// A surface in rest space [m] along which a body is cut, with consistent orientation. It may end inside the
/// body. Triangles without area are allowed and cut nothing.
using CutPatch = TriangleMesh;

/// The ruled surface that a leading edge, a polyline, sweeps from one position to the next. Quadrilaterals
/// are split along the diagonal with the smaller fold.
/// @param before, now: #P by 3, #P >= 2, corresponding points of the edge.
/// @throw std::invalid_argument if the numbers of points differ or are below 2.
CutPatch ruledPatch(const Points& before, const Points& now);

/// Both patches as one: the vertices and triangles of the first, then of the second.
CutPatch joined(const CutPatch& first, const CutPatch& second);

/// The patch moved by 20 nm in a fixed oblique direction, less than the resolution of Point32 on a body of
/// 0.3 m. A patch through vertices, edges or faces then crosses edges and faces in their interior only, which
/// removes degenerate cases. All models of a body are cut by the same moved patch.
CutPatch inGeneralPosition(CutPatch patch);

/// Coordinates rounded to the precision of Point32, as they are published.
Points inSinglePrecision(const Points& points);
Eigen::Vector3d rounded(const Eigen::Vector3d& point);

}  // namespace softbody
