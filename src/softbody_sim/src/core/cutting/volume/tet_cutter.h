#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cutting/patch/cut_patch.h"
#include "cutting/volume/crack_opening.h"
#include "cutting/volume/cut_subdivision.h"
#include "cutting/volume/tet_edit.h"
#include "softbody_common/types.h"

namespace softbody {

/// What a stroke of the blade has cut so far; empty when it begins.
struct CutStroke {
  CutPatch patch;            ///< all of it
  std::vector<bool> on_cut;  ///< per vertex of the topology
  /// Along the patch, but still held together at all three vertices; ascending.
  std::vector<Face> closed_faces;
};

/// The tets cut along a patch, one step of a stroke.
///
/// Conforming by construction: every decision belongs to an edge, a face or a vertex, never to a tet. (1) the
/// patch separates the ends of an edge or not; (2) separated edges are split at the crossing, or their near
/// end is taken to lie on the cut; then every tet is on one side; (3) a face is cut if its vertices are on
/// the cut and the patch separates its tets; (4) vertices are copied where cut faces part their tets. Faces
/// that would leave the surface non-manifold stay closed until the stroke has come further.
///
/// @param cut per triangle of the topology's surface, as in TetEdit.
/// @param stroke advances with or without an edit.
/// @param reason why there is no edit.
/// @throw std::invalid_argument if the patch is not finite or names a vertex that it does not have.
std::optional<TetEdit> cutTets(const TetTopology& topology, const std::vector<bool>& cut,
                               const CutPatch& patch, const SubdivisionSettings& settings, CutStroke* stroke,
                               std::string* reason);

}  // namespace softbody
