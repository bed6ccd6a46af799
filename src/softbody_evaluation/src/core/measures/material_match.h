#pragma once

#include <array>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/records/material_map.h"

namespace softbody::evaluation {

/// The motion with its vertices: each vertex of an uncut mesh goes where the truth's uncut mesh is nearest.
/// @param motion from the rest places of `mesh` to those of the truth.
MaterialMap materialMap(const Eigen::Isometry3d& motion, const MeshTopology& mesh, const MeshTopology& truth);

/// The result's topology with the rest places and file vertices of the truth's material.
MeshTopology inTruthMaterial(const MaterialMap& map, MeshTopology result);

/// A vertex of the result whose material lies between the truth's vertices: in a triangle of the truth.
struct PlaceBetween {
  int vertex = -1;
  std::array<int, 3> corners = {-1, -1, -1};
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the corners, sum 1
};

/// The truth's vertex for each vertex of a result.
struct VertexMatches {
  std::vector<int> vertices;          ///< from matchVertices
  std::vector<PlaceBetween> between;  ///< of the file's vertices that the truth does not have in this place
};

/// matchVertices, with the places between the truth's vertices. Only a MaterialMap makes such places.
VertexMatches matchMaterial(const MaterialMap& map, const MeshTopology& result, const MeshTopology& truth,
                            double largest_m);

/// The result's state with vertices between the truth's vertices moved by the vector from their place in the
/// truth to their matched vertex. So the distance from this vertex is the distance from the place.
MeshState ontoVertices(MeshState result, const MeshState& truth, const VertexMatches& matches);

}  // namespace softbody::evaluation
