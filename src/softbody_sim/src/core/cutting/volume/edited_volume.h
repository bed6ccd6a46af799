#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cutting/volume/cut_history.h"
#include "softbody_common/cut.h"

namespace softbody {

/// Applies a Cut to the history of a body. @return nothing, without any change, if its revision is not the
/// next one or there is nothing to undo or redo; `reason` then says why.
/// @throw std::invalid_argument as cutTets.
std::optional<TetEdit> applyCut(const Cut& cut, CutHistory* history, std::string* reason);

/// The tets of a body that is being cut, with its recent revisions.
class EditedVolume {
 public:
  explicit EditedVolume(const TetTopology& uncut);

  const TetTopology& topology() const { return history_.topology(); }
  const CutHistory& history() const { return history_; }

  /// See applyCut.
  std::optional<TetEdit> apply(const Cut& cut, std::string* reason);

  /// Converts targets on tets of a recent revision to tets of the present one. Drops targets that are far
  /// outside of their new tet. Returns targets of other revisions unchanged.
  TargetSet toCurrentRevision(TargetSet targets) const;

 private:
  struct Step {
    std::shared_ptr<const TetEdit> before;  ///< with the earlier topology
    std::shared_ptr<const TetEdit> edit;
  };
  CutHistory history_;
  std::deque<Step> recent_;  ///< oldest first
};

}  // namespace softbody
