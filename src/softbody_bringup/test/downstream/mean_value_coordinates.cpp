#include "softbody_sim/mean_value/mean_value_coordinates.h"

#include <iostream>

/// The weights of a point in a tetrahedron with respect to its corners.
int main() {
  softbody::Points corners(4, 3), point(1, 3);
  corners << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  softbody::Triangles faces(4, 3);
  faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  point << 0.2, 0.3, 0.1;
  softbody::WeightRows weights;
  const std::vector<int> winding = softbody::MeanValueCage(corners, faces).coordinates(point, &weights);
  std::cout << weights << '\n';
  return winding[0] == 1 && (weights * corners - point).norm() < 1e-12 ? 0 : 1;
}
