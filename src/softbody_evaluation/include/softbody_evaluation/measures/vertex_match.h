#pragma once

#include <cstdint>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::evaluation {

/// Which truth vertex each result vertex stands for (the one with the same index in the input file); -1:
/// none, as for vertices made by a cut. @param parents MeshTopology::vertex_parents of both.
std::vector<int> matchVertices(const std::vector<int>& result_parents, const std::vector<int>& truth_parents);

/// Whether vertices of the same index in the input file lie at one place at rest, to a millionth of the
/// truth's diagonal and what messages round, and there are such vertices. What a file's welding left out in
/// one of both is not judged.
bool sameMesh(const MeshTopology& mesh, const MeshTopology& truth);

/// The same across cuts: a vertex that a cut copied stands for the copy on the same side (of those in the
/// piece that its own stands for, if there are any, the one whose triangles lie nearer at rest and face the
/// same way), one that a cut made for the nearest such vertex of the truth, if it is within `largest_m` at
/// rest. Both topologies' rest vertices are in the same frame.
std::vector<int> matchVertices(const MeshTopology& result, const MeshTopology& truth, double largest_m);

/// Which true piece each piece of the result stands for: the one that shares most vertices with it, largest
/// share first, each at most once.
struct PieceMatch {
  std::size_t result_pieces = 0, true_pieces = 0;
  std::vector<int> true_piece;  ///< per piece of the result, -1: none
  double vertices_right = 0.0;  ///< share of the matched vertices that are in the right piece, 0..1
};

/// @param matches of matchVertices.
PieceMatch matchPieces(const MeshTopology& result, const MeshTopology& truth,
                       const std::vector<int>& matches);

/// Piece of every vertex; -1 where no triangle is.
std::vector<int> vertexPieces(const MeshTopology& topology);

/// Which vertices are at rest within `near_m` of a corner of a triangle that fills a cut.
std::vector<bool> nearCut(const MeshTopology& topology, double near_m);

}  // namespace softbody::evaluation
