#include "dynamics/target_validation.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace softbody {
namespace {

/// A target farther outside of its tet gives no information about the tet. Its squared coordinates in the
/// metric would also exceed the body's own stiffness.
constexpr double kLargestBarycentric = 100.0;

void requireUsable(const Target& target, std::size_t index, Eigen::Index tet_count, double largest_weight) {
  if (target.place.tet < 0 || target.place.tet >= tet_count) {
    throw std::invalid_argument(
        fmt::format("targets[{}] names tet {}; the volume has {} tets", index, target.place.tet, tet_count));
  }
  const bool finite = target.place.barycentric.allFinite() && target.position.allFinite() &&
                      target.normal.allFinite() && std::isfinite(target.weight);
  if (!finite) throw std::invalid_argument(fmt::format("targets[{}] is not finite", index));
  if (target.weight <= 0.0 || target.weight > largest_weight) {
    throw std::invalid_argument(fmt::format("targets[{}] has weight {}; allowed: above 0, up to {}", index,
                                            target.weight, largest_weight));
  }
  if (target.place.barycentric.cwiseAbs().maxCoeff() > kLargestBarycentric) {
    throw std::invalid_argument(fmt::format("targets[{}] has a barycentric coordinate outside of [-{}, {}]",
                                            index, kLargestBarycentric, kLargestBarycentric));
  }
}

}  // namespace

void requireUsable(const TargetSet& targets, const TetTopology& topology, double largest_weight) {
  if (targets.revision != topology.revision) {
    throw std::invalid_argument(fmt::format("targets are for revision {} of the volume, which is at {}",
                                            targets.revision, topology.revision));
  }
  if (targets.reset && !targets.body_pose.matrix().allFinite())
    throw std::invalid_argument("body_pose is not finite");
  for (std::size_t i = 0; i < targets.targets.size(); ++i)
    requireUsable(targets.targets[i], i, topology.tets.rows(), largest_weight);
}

}  // namespace softbody
