#pragma once

#include "cutting/fill/cut_fill.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// Gives the triangles at a cut a good shape: those of the skin around the curve, and those of the fill.
/// Vertices near the curve are merged, moved in the surface or replaced. The curve's vertices move along it.
/// Texture coordinates are interpolated. Seams of the texture stay, and so do the faces of earlier cuts.
/// @param is_cut per triangle of the mesh: it fills an earlier cut.
/// @param distance by which skin, curve and fill may move [m].
/// @throw CutRefused if the new fill does not reach the whole curve.
void remeshCut(const std::vector<bool>& is_cut, double distance, SplitSurface* surface, CutFill* fill);

}  // namespace softbody
