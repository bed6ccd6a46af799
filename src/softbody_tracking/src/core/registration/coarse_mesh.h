#pragma once

#include "picture/baked_picture.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A coarser mesh with the same outline: all vertices of one cubic cell become one vertex.
/// @param cell_m side of a cell [m]; halved until enough of a thin mesh's area remains.
/// @param smallest_area that is enough, as a share of the mesh's.
TriangleMesh clustered(const TriangleMesh& mesh, double cell_m, double smallest_area);

/// The rest surface at the resolutions that the searches for its pose render.
struct SearchMeshes {
  TriangleMesh full;
  TriangleMesh fine;          ///< from full, for the last step of a search, and to judge its pose
  TriangleMesh coarse;        ///< from fine, for the steps before
  double diameter_m = 0.0;    ///< diagonal of the bounding box
  BakedPicture picture = {};  ///< of the full mesh; empty: not known
};

SearchMeshes makeSearchMeshes(const TriangleMesh& rest_surface);

/// The same with the body's picture. @param picture blue, green, red; empty: not known.
SearchMeshes makeSearchMeshes(const MeshTopology& surface, const cv::Mat3b& picture);

}  // namespace softbody
