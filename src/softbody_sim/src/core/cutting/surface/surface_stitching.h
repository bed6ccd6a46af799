#pragma once

#include "cutting/split/split_surface.h"
#include "cutting/surface/wall_fill.h"

namespace softbody {

/// A mesh that a cut has opened.
struct StitchedSurface {
  std::vector<Eigen::Vector3d> vertices;
  TriangleList
      triangles;  ///< the split surface's, then the walls on the patch's back, then those on its front
  std::vector<int> mates;
  std::vector<int> copied_from;  ///< per vertex: the split surface's vertex that it is or was copied from;
                                 ///< -1: the walls' own
};

/// Opens a surface along a cut's curve and closes it with two walls, one the mirror image of the other.
/// Triangles are paired edge by edge; a vertex is then what the triangles round it share, so the result is a
/// closed manifold whatever the cut looks like. The fill gets a point more where two of the walls' edges
/// would have the same ends.
/// @throw CutRefused if that does not help.
StitchedSurface stitch(const SplitSurface& surface, WallFill fill);

}  // namespace softbody
