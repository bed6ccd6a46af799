#include "cutting/volume/edited_volume.h"

#include <algorithm>
#include <utility>

#include "cutting/volume/undo_versions.h"

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
  *reason = refusalOf(cut, history->edits());
  if (!reason->empty()) return std::nullopt;
  switch (cut.kind) {
    case CutKind::kCut:
      return history->cutOrAdvance(cut.patch, cut.stroke);
    case CutKind::kUndo:
      return history->undo();
    case CutKind::kRedo:
      return history->redo();
    case CutKind::kReset:
      return history->reset();
  }
  return std::nullopt;
}

EditedVolume::EditedVolume(const TetTopology& uncut, std::size_t undo_bytes)
    : undo_bytes_(undo_bytes), history_(uncut) {}

void EditedVolume::makeRoomFor(const Cut& cut) { softbody::makeRoomFor(cut, &history_); }

std::optional<TetEdit> EditedVolume::apply(const Cut& cut, std::string* reason) {
  const std::size_t version = versionAfter(cut, history_.edits());
  if (!history_.has(version)) restoreVersion(version, undo_bytes_, &history_);
  std::shared_ptr<const TetEdit> before = history_.version();
  std::optional<TetEdit> edit = applyCut(cut, &history_, reason);
  if (!edit) return edit;
  // The first cut of a stroke is its version, which is shared.
  const std::shared_ptr<const TetEdit> after = history_.version();
  const bool is_version = history_.edits().is_open && history_.edits().strokes.back().patches.size() == 1;
  recent_.push_back({std::move(before), is_version ? after : std::make_shared<TetEdit>(*edit)});
  if (recent_.size() > kRemembered) recent_.pop_front();
  dropVersions(undo_bytes_, &history_);
  return edit;
}

bool EditedVolume::crosses(const Cut& cut, std::string* reason) const {
  return history_.preview(cut.patch, cut.stroke, reason).has_value();
}

void EditedVolume::take(const EditHistory& edits) {
  if (edits.revision != topology().revision) recent_.clear();
  history_.take(edits);
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
