#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cutting/volume/cut_history.h"
#include "softbody_common/cut.h"

namespace softbody {

/// Carries out a Cut on the strokes of a body. @return nothing, and nothing is changed, if its revision is
/// not the next one or there is nothing to undo or redo; `reason` then says which.
/// @throw std::invalid_argument as cutTets.
std::optional<TetEdit> applyCut(const Cut& cut, CutHistory* history, std::string* reason);

/// The tets of a body that is being cut, and the way from its recent revisions to the present one.
class EditedVolume {
 public:
  explicit EditedVolume(const TetTopology& uncut);

  const TetTopology& topology() const { return history_.topology(); }
  const CutHistory& history() const { return history_; }

  /// As applyCut.
  std::optional<TetEdit> apply(const Cut& cut, std::string* reason);

  /// Targets that name tets of a recent revision, by the tets that took their room since. Those that lie far
  /// outside of such a tet say nothing of it and are left out. Targets of no recent revision are returned as
  /// they are.
  TargetSet broughtUpToDate(TargetSet targets) const;

 private:
  struct Step {
    std::shared_ptr<const TetEdit> before;  ///< its topology
    std::shared_ptr<const TetEdit> edit;
  };
  CutHistory history_;
  std::deque<Step> recent_;  ///< oldest first
};

}  // namespace softbody
