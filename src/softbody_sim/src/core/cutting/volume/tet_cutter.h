#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cutting/patch/cut_patch.h"
#include "cutting/volume/crack_opening.h"
#include "cutting/volume/cut_subdivision.h"
#include "cutting/volume/tet_edit.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The progress of a stroke of the blade; empty at its beginning.
struct CutStroke {
  CutPatch patch;            ///< all of it
  std::vector<bool> on_cut;  ///< per vertex of the topology
  /// Faces along the patch that are still connected at all three vertices; ascending.
  std::vector<Face> closed_faces;
};

/// Cuts the tets along a patch, one step of a stroke.
///
/// The mesh stays conforming: every decision belongs to an edge, a face or a vertex, never to a tet. (1) The
/// patch separates the ends of an edge or not. (2) Separated edges are split at the crossing, or their nearer
/// end is put on the cut. Then every tet is on one side. (3) A face is cut if its vertices are on the cut and
/// the patch separates its tets. (4) Vertices are duplicated where cut faces separate their tets. Faces that
/// would make the surface non-manifold stay closed until the stroke has advanced.
///
/// @param cut per triangle of the topology's surface, as in TetEdit.
/// @param stroke advances even without an edit. @param reason why there is no edit.
/// @throw std::invalid_argument if the patch is not finite or refers to a missing vertex.
std::optional<TetEdit> cutTets(const TetTopology& topology, const std::vector<bool>& cut,
                               const CutPatch& patch, const SubdivisionSettings& settings, CutStroke* stroke,
                               std::string* reason);

}  // namespace softbody
