#pragma once

#include <cstdint>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// The true vertex of each vertex of the result: the one with the same index in the input file. -1: none,
/// e.g. for vertices made by a cut. @param result_parents, truth_parents MeshTopology::vertex_parents.
std::vector<int> matchVertices(const std::vector<int>& result_parents, const std::vector<int>& truth_parents);

/// Whether both are made from the same file: vertices of the same index in the file have the same position at
/// rest, within a millionth of the truth's diagonal plus rounding. Vertices that are in only one of the two
/// are ignored. False if there are no common vertices.
bool sameMesh(const MeshTopology& mesh, const MeshTopology& truth);

/// Matches vertices across cuts. A vertex that a cut copied is matched to the copy on the same side: a copy
/// in the matched piece if there is one, and the copy whose triangles are nearest at rest and have the most
/// similar normals. A vertex that a cut made is matched to the nearest such vertex of the truth, up to
/// `largest_m` away at rest. The rest vertices of both are in the same frame.
std::vector<int> matchVertices(const MeshTopology& result, const MeshTopology& truth, double largest_m);

/// The true piece of each piece of the result: the piece with most common vertices. Pairs with more common
/// vertices are matched first, and each true piece is matched at most once.
struct PieceMatch {
  std::size_t result_pieces = 0, true_pieces = 0;
  std::vector<int> true_piece;  ///< per piece of the result, -1: none
  double vertices_right = 0.0;  ///< share of the matched vertices in the right piece, 0..1
};

/// @param matches from matchVertices.
PieceMatch matchPieces(const MeshTopology& result, const MeshTopology& truth,
                       const std::vector<int>& matches);

/// The piece of every vertex; -1 for a vertex without triangles.
std::vector<int> vertexPieces(const MeshTopology& topology);

/// Whether each vertex is, at rest, within `near_m` of a corner of a triangle that fills a cut.
std::vector<bool> nearCut(const MeshTopology& topology, double near_m);

}  // namespace softbody::evaluation
