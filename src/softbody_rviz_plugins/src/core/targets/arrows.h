#pragma once

#include <vector>

#include "softbody_common/geometry/types.h"
#include "surface/mesh_layout.h"

namespace softbody {

struct Arrow {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< [m]
};

/// From where the body is to where a target pulls it. A target with a normal pulls along it only.
/// @param vertices of the tets [m]. @param stretch makes the arrows longer, from their starts.
Arrow arrowOf(const Target& target, const Points& vertices, const Tets& tets, double stretch);

constexpr int kVerticesPerArrow = 13;

/// Room for arrows that are placed in each frame.
MeshLayout layoutOfArrows(int capacity);

/// Vertices of the arrows; the rest of the capacity becomes invisible. @param width of the shafts [m].
std::vector<PlacedVertex> placeArrows(const std::vector<Arrow>& arrows, int capacity, double width);

}  // namespace softbody
