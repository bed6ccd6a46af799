#include "piece_hold.h"

namespace softbody {

PieceHold::PieceHold(const TetTopology& volume)
    : places_(static_cast<std::size_t>(volume.rest_vertices.rows())) {
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k)
      places_[static_cast<std::size_t>(volume.tets(t, k))] = {static_cast<int>(t), Eigen::Vector4d::Unit(k)};
  }
}

void PieceHold::add(const std::vector<int>& vertices, const Points& positions, double weight,
                    std::vector<Target>* targets) const {
  for (const int v : vertices) {
    Target target;
    target.kind = TargetKind::kVertex;
    target.place = places_[static_cast<std::size_t>(v)];
    target.position = positions.row(v);
    target.weight = weight;
    targets->push_back(target);
  }
}

}  // namespace softbody
