#include "cutting/volume/recent_edits.h"

#include <algorithm>
#include <utility>

#include "cutting/volume/tet_edit.h"

namespace softbody {
namespace {

/// Targets are one or two frames late, and a stroke edits at most once per frame.
constexpr std::size_t kRemembered = 4;

/// Absolute value of a barycentric coordinate above which a target is dropped.
constexpr double kFarOutside = 20.0;

std::vector<Target> mapped(std::vector<Target> targets, const TetTopology& before, const TetEdit& edit) {
  const auto tet_count = static_cast<int>(before.tets.rows());
  for (Target& target : targets) {
    if (target.place.tet < 0 || target.place.tet >= tet_count || !target.place.barycentric.allFinite())
      continue;  // the simulator reports the error
    target.place = edit.placeAfter(target.place, before);
  }
  const auto far_outside = [](const Target& target) {
    return target.place.barycentric.cwiseAbs().maxCoeff() > kFarOutside;
  };
  targets.erase(std::remove_if(targets.begin(), targets.end(), far_outside), targets.end());
  return targets;
}

}  // namespace

void RecentEdits::add(const TetTopology& before, const TetEdits& edits) {
  if (edits.size() != 1) return clear();
  Step step{nullptr, edits.front()};
  if (steps_.empty())
    step.before = std::make_shared<const TetTopology>(before);
  else
    step.before = {steps_.back().edit, &steps_.back().edit->topology};
  steps_.push_back(std::move(step));
  if (steps_.size() > kRemembered) steps_.pop_front();
}

TargetSet RecentEdits::toCurrentRevision(TargetSet targets) const {
  for (const Step& step : steps_) {
    if (targets.revision != step.before->revision) continue;
    targets.targets = mapped(std::move(targets.targets), *step.before, *step.edit);
    targets.revision = step.edit->topology.revision;
  }
  return targets;
}

}  // namespace softbody
