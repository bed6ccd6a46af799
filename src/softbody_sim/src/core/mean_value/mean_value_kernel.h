#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The edges and faces of a closed triangle mesh, in the order of the kernel.
struct CageMesh {
  struct Edge {
    int from, to;
  };
  /// Edge k runs from corner k to corner k + 1; sign -1: against the stored direction.
  struct Face {
    int corners[3];
    int edges[3];
    double signs[3];
  };
  Points vertices;
  double size = 0.0;  ///< of the bounding box [m]
  std::vector<Edge> edges;
  std::vector<Face> faces;
};

/// A point on the cage, for which the general formula does not hold.
struct CageContact {
  int vertex = -1;  ///< the point is on it
  int face = -1;    ///< the point is on it
};

/// Mean value coordinates of many points. A SIMD vector holds one point per lane (Highway, dispatched at run
/// time).
/// @param weights #P by #C, row-major, overwritten; rows sum to 1. Undefined for points with a contact.
/// @param turns #P, the cage's winding number around each point. @param contacts #P.
void meanValueKernel(const CageMesh& cage, const double* points, int count, double* weights, int* turns,
                     CageContact* contacts);

}  // namespace softbody
