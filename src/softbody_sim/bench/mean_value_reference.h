#pragma once

#include "softbody_sim/mean_value/mean_value_coordinates.h"

namespace softbody::bench {

/// Reference for mean value coordinates: the pseudo-code of Ju, Schaefer and Warren (2005), figure 4, for one
/// point and one triangle at a time.
/// @tparam Scalar double to compare times, long double to compare weights. The formula loses half of the
/// digits if a point is almost in the plane of a triangle.
template <typename Scalar>
void referenceMeanValueCoordinates(const Points& points, const Points& cage_vertices,
                                   const Triangles& cage_triangles, WeightRows* weights);

extern template void referenceMeanValueCoordinates<double>(const Points&, const Points&, const Triangles&,
                                                           WeightRows*);
extern template void referenceMeanValueCoordinates<long double>(const Points&, const Points&,
                                                                const Triangles&, WeightRows*);

}  // namespace softbody::bench
