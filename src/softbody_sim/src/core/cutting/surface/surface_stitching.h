#pragma once

#include "cutting/fill/cut_fill.h"
#include "cutting/split/split_surface.h"

namespace softbody {

/// A mesh opened by a cut.
struct StitchedSurface {
  std::vector<Eigen::Vector3d> vertices;
  TriangleList triangles;  ///< of the split surface, then the wall at the back of the patch, then the wall at
                           ///< its front
  std::vector<int> mates;
  std::vector<int> copied_from;  ///< per vertex: its vertex of the split surface, or the original of the
                                 ///< copy; -1: a new vertex of a wall
};

/// Opens a surface along the curve of a cut and closes it with two walls, mirror images of each other.
/// Half-edges are paired first. A vertex is then defined by the triangles around it, so the result is always
/// a closed manifold. If two edges of the walls would have the same ends, the fill gets another point. @throw
/// CutRefused if duplicate edges remain.
StitchedSurface stitch(const SplitSurface& surface, CutFill fill);

}  // namespace softbody
