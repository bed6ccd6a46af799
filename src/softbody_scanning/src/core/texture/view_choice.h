#pragma once

#include "texture/edge_neighbors.h"
#include "texture/triangle_views.h"

namespace softbody::scanning {

/// The frame of each triangle; -1 without views. Few seams and good views: Potts model, solved by belief
/// propagation (min-sum) and then iterated conditional modes (Besag 1986).
std::vector<int> chooseViews(const EdgeNeighbors& neighbors, const TriangleViews& views);

}  // namespace softbody::scanning
