#pragma once

#include "texture/edge_neighbors.h"
#include "texture/triangle_views.h"

namespace softbody::scanning {

/// Takes out the views whose colour differs from that of a triangle's other views: a hand, or light that the
/// surface mirrors (Waechter et al. 2014, section 4.2, with a median as the start). An edge of what is in
/// front lies in triangles beside: they lose that view, too, if they have another one.
void removeOutliers(const EdgeNeighbors& neighbors, TriangleViews* views);

}  // namespace softbody::scanning
