#include "prediction/vertex_places.h"

namespace softbody {

std::vector<MaterialPoint> vertexPlaces(const TetTopology& volume) {
  std::vector<MaterialPoint> places(static_cast<std::size_t>(volume.rest_vertices.rows()));
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k)
      places[static_cast<std::size_t>(volume.tets(t, k))] = {static_cast<int>(t), Eigen::Vector4d::Unit(k)};
  }
  return places;
}

}  // namespace softbody
