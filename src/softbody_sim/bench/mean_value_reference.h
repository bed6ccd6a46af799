#pragma once

#include "softbody_sim/interpolation/mean_value_coordinates.h"

namespace softbody::bench {

/// Mean value coordinates straight from the pseudo-code of Ju, Schaefer and Warren (2005), figure 4, one
/// point and one triangle at a time: what the product's are compared with.
/// @tparam Scalar double, to compare the time with; long double, to compare the weights with (the formula
/// loses half of the digits where a point is nearly in the plane of a triangle).
template <typename Scalar>
void referenceMeanValueCoordinates(const Points& points, const Points& cage_vertices,
                                   const Triangles& cage_triangles, WeightRows* weights);

extern template void referenceMeanValueCoordinates<double>(const Points&, const Points&, const Triangles&,
                                                           WeightRows*);
extern template void referenceMeanValueCoordinates<long double>(const Points&, const Points&,
                                                                const Triangles&, WeightRows*);

}  // namespace softbody::bench
