#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "cutting/volume/cut_history.h"
#include "softbody_common/cutting/cut.h"

namespace softbody {

/// Applies a Cut to the history of a body. @return nothing, without any change, if it is not possible;
/// `reason` then says why. @throw std::invalid_argument as cutTets.
std::optional<TetEdit> applyCut(const Cut& cut, CutHistory* history, std::string* reason);

/// The tets of a body that is being cut, with its recent revisions.
class EditedVolume {
 public:
  /// @param undo_bytes of the versions that are kept for undo and redo.
  EditedVolume(const TetTopology& uncut, std::size_t undo_bytes);

  const TetTopology& topology() const { return history_.topology(); }
  const CutHistory& history() const { return history_; }

  /// See undo_versions.h.
  void makeRoomFor(const Cut& cut);
  /// See applyCut.
  std::optional<TetEdit> apply(const Cut& cut, std::string* reason);
  /// Whether a cut would cut a tet. @param reason why not.
  bool crosses(const Cut& cut, std::string* reason) const;
  /// See CutHistory::take.
  void take(const EditHistory& edits);
  void setBody(std::uint64_t body) { history_.setBody(body); }

  /// Converts targets on tets of a recent revision to tets of the present one. Drops targets that are far
  /// outside of their new tet. Returns targets of other revisions unchanged.
  TargetSet toCurrentRevision(TargetSet targets) const;

 private:
  struct Step {
    std::shared_ptr<const TetEdit> before;  ///< with the earlier topology
    std::shared_ptr<const TetEdit> edit;
  };
  std::size_t undo_bytes_;
  CutHistory history_;
  std::deque<Step> recent_;  ///< oldest first
};

}  // namespace softbody
