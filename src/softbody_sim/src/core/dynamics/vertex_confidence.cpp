#include "dynamics/vertex_confidence.h"

#include <algorithm>
#include <cmath>

namespace softbody {

VertexConfidence::VertexConfidence(const Points& rest_vertices, const Tets& tets)
    : tets_(tets), edges_(rest_vertices, tets) {
  const auto count = static_cast<std::size_t>(rest_vertices.rows());
  support_.reserve(count);
  distance_.reserve(count);
  observed_.reserve(count);
}

void VertexConfidence::compute(const std::vector<Target>& targets, std::vector<float>* confidence) {
  constexpr double kObserved = 0.25;
  support_.assign(support_.capacity(), 0.0);
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    for (int k = 0; k < 4; ++k) {
      support_[tets_(target.place.tet, k)] += target.weight * std::max(0.0, target.place.barycentric[k]);
    }
  }
  observed_.clear();
  for (const double support : support_) observed_.push_back(support >= kObserved ? 1 : 0);
  edges_.fromNearest(observed_, &distance_);
  confidence->resize(distance_.size());
  for (std::size_t v = 0; v < distance_.size(); ++v)
    (*confidence)[v] = static_cast<float>(std::exp(-distance_[v] / (2.0 * edges_.meanLength())));
}

}  // namespace softbody
