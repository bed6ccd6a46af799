#pragma once

#include "softbody_common/types.h"

namespace softbody {

/// A surface in rest space [m] along which a body is cut. Its triangles agree in orientation; it may end
/// inside the body. A triangle with no area is allowed and cuts nothing.
using CutPatch = TriangleMesh;

/// What a straight leading edge, or a polyline, sweeps: ruled between the edge before and the edge now.
/// Quadrilaterals are split along the diagonal that folds the patch less; where both edges meet it has
/// triangles.
/// @param before, now: #P by 3, #P >= 2, corresponding points of the edge.
/// @throw std::invalid_argument if the numbers of points differ or are below 2.
CutPatch ruledPatch(const Points& before, const Points& now);

/// Both patches, the second behind the first.
CutPatch joined(const CutPatch& first, const CutPatch& second);

/// The patch moved by 20 nm in a fixed oblique direction, less than Point32 resolves on a body of 0.3 m. A
/// patch laid through vertices, edges or faces on purpose then crosses edges and faces in their interior
/// only, and every question has one answer. The models of a body are cut by the same moved patch.
CutPatch inGeneralPosition(CutPatch patch);

/// Coordinates as Point32 holds them.
Points inSinglePrecision(const Points& points);

}  // namespace softbody
