#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/cutting/crack_opening.h"
#include "core/cutting/cut_patch.h"
#include "core/cutting/cut_subdivision.h"
#include "softbody_common/types.h"

namespace softbody {

/// A topological edit of the tets and what whoever holds something of the topology before needs.
struct TetEdit {
  TetTopology topology;                       ///< after: vertices and tets of before keep their numbers
  std::vector<bool> cut;                      ///< per triangle of its surface: was inside the uncut body
  std::vector<MaterialPoint> vertex_origins;  ///< per vertex: its place in the topology before
  std::vector<std::vector<int>> successors;   ///< per tet before: the tets that took its room

  /// A place of the topology before, in the successor that contains it or is nearest.
  MaterialPoint placeAfter(const MaterialPoint& place, const TetTopology& before) const;
};

/// Per vertex of a topology its place at a corner of its lowest tet.
std::vector<MaterialPoint> placesOfVertices(const TetTopology& topology);

/// What a stroke of the blade has cut so far; empty when it begins.
struct CutStroke {
  CutPatch patch;            ///< all of it
  std::vector<bool> on_cut;  ///< per vertex of the topology
  std::vector<Face>
      closed_faces;  ///< along the patch, but still held together at all three vertices; ascending
};

/// The tets cut along a patch, one step of a stroke.
///
/// Conforming by construction, after the idea of Sifakis et al. (2007) and Koschier et al. (2014) that every
/// decision belongs to an edge, a face or a vertex, never to a tet: (1) the patch separates the ends of an
/// edge or not; (2) separated edges are split at the crossing, or their near end is taken to lie on the cut;
/// then every tet is on one side; (3) a face is cut if its vertices are on the cut and the patch separates
/// its tets; (4) vertices are copied where cut faces part their tets. Faces that would leave the surface
/// non-manifold stay closed until the stroke has come further.
///
/// @param cut per triangle of the topology's surface, as in TetEdit.
/// @param stroke advances with or without an edit.
/// @param reason why there is no edit.
/// @throw std::invalid_argument if the patch is not finite or names a vertex that it does not have.
std::optional<TetEdit> cutTets(const TetTopology& topology, const std::vector<bool>& cut,
                               const CutPatch& patch, const SubdivisionSettings& settings, CutStroke* stroke,
                               std::string* reason);

}  // namespace softbody
