#include "targets/position_prior.h"

#include "prediction/vertex_places.h"

namespace softbody {
PositionPrior::PositionPrior(const TetTopology& volume) : places_(vertexPlaces(volume)) {}

void PositionPrior::addTargets(const std::vector<int>& vertices, const Points& positions, double weight,
                               std::vector<Target>* targets) const {
  for (const int v : vertices) {
    Target target;
    target.kind = TargetKind::kPrior;
    target.place = places_[static_cast<std::size_t>(v)];
    target.position = positions.row(v);
    target.weight = weight;
    targets->push_back(target);
  }
}

}  // namespace softbody
