#include "cutting/volume/edited_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

std::optional<TetEdit> applyCut(const Cut& cut, CutHistory* history, std::string* reason) {
  const std::uint32_t revision = history->topology().revision;
  if (cut.revision != revision + 1) {
    *reason = fmt::format("its revision is {}, but the body is at revision {}", cut.revision, revision);
    return std::nullopt;
  }
  std::optional<TetEdit> edit;
  switch (cut.kind) {
    case CutKind::kCut:
      return history->cutOrAdvance(cut.patch, cut.stroke);
    case CutKind::kUndo:
      edit = history->undo();
      if (!edit) *reason = "there is no cut to undo";
      return edit;
    case CutKind::kRedo:
      edit = history->redo();
      if (!edit) *reason = "there is no cut to redo";
      return edit;
    case CutKind::kReset:
      edit = history->reset();
      if (!edit) *reason = "the body is not cut";
      return edit;
  }
  *reason = "its kind is unknown";
  return std::nullopt;
}

EditedVolume::EditedVolume(const TetTopology& uncut) : history_(uncut) {}

std::optional<TetEdit> EditedVolume::apply(const Cut& cut, std::string* reason) {
  std::shared_ptr<const TetEdit> before = history_.version();
  std::optional<TetEdit> edit = applyCut(cut, &history_, reason);
  if (!edit) return edit;
  recent_.push_back({std::move(before), std::make_shared<TetEdit>(*edit)});
  if (recent_.size() > kRemembered) recent_.pop_front();
  return edit;
}

TargetSet EditedVolume::toCurrentRevision(TargetSet targets) const {
  for (const Step& step : recent_) {
    if (targets.revision != step.before->topology.revision) continue;
    targets.targets = mapped(std::move(targets.targets), step.before->topology, *step.edit);
    targets.revision = step.edit->topology.revision;
  }
  return targets;
}

}  // namespace softbody
