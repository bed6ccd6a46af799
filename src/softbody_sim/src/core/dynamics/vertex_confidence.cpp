#include "dynamics/vertex_confidence.h"

#include <algorithm>
#include <cmath>

namespace softbody {

VertexConfidence::VertexConfidence(const Points& rest_vertices, const Tets& tets)
    : tets_(tets),
      edges_(rest_vertices, tets),
      support_(static_cast<std::size_t>(rest_vertices.rows())),
      observed_(support_.size()) {
  distance_.reserve(support_.size());
}

void VertexConfidence::compute(const std::vector<Target>& targets, std::vector<float>* confidence) {
  constexpr double kObserved = 0.25;  // one corner of a target of weight 1 in the middle of its tet
  std::fill(support_.begin(), support_.end(), 0.0);
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    for (int k = 0; k < 4; ++k) {
      support_[tets_(target.place.tet, k)] += target.weight * std::max(0.0, target.place.barycentric[k]);
    }
  }
  for (std::size_t v = 0; v < support_.size(); ++v) observed_[v] = support_[v] >= kObserved ? 1 : 0;
  edges_.fromNearest(observed_, &distance_);
  confidence->resize(distance_.size());
  for (std::size_t v = 0; v < distance_.size(); ++v)
    (*confidence)[v] = static_cast<float>(std::exp(-distance_[v] / (2.0 * edges_.meanLength())));
}

}  // namespace softbody
