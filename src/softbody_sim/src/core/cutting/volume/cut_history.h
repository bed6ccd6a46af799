#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cutting/volume/tet_cutter.h"

namespace softbody {

/// The tets of a body through strokes of the blade, undo and redo. A stroke is one undo step, whatever the
/// number of its cuts. An undone topology is the one from before, bit for bit, but for its revision: that
/// only rises.
class CutHistory {
 public:
  explicit CutHistory(const TetTopology& uncut, const SubdivisionSettings& settings = {});

  const TetTopology& topology() const { return versions_[at_]->topology; }
  /// Per triangle of the topology's surface: was inside the uncut body.
  const std::vector<bool>& cut() const { return versions_[at_]->cut; }
  /// The topology with the edit that led to it from the version before, or, uncut, none.
  std::shared_ptr<const TetEdit> version() const { return versions_[at_]; }

  /// Cuts along a patch. Another stroke number than in the last call begins a new stroke, and so does the
  /// same one after undo, redo or reset. Nothing but the stroke's progress changes if there is no edit, whose
  /// `reason` is then given. What was undone can no longer be redone after an edit.
  /// @throw std::invalid_argument as cutTets.
  std::optional<TetEdit> cut(const CutPatch& patch, std::uint32_t stroke, std::string* reason);

  /// As cut, but a patch that crosses nothing of the tets is an edit too, which changes only the revision:
  /// the visual mesh, which is finer, may be cut by it.
  TetEdit cutOrAdvance(const CutPatch& patch, std::uint32_t stroke);

  /// What cut would do, without doing it.
  std::optional<TetEdit> preview(const CutPatch& patch, std::uint32_t stroke, std::string* reason) const;

  std::optional<TetEdit> undo();   ///< nothing if there is no stroke before
  std::optional<TetEdit> redo();   ///< nothing if no stroke is undone
  std::optional<TetEdit> reset();  ///< to the uncut body; can be redone stroke by stroke

 private:
  CutStroke strokeFor(std::uint32_t number) const;
  std::optional<TetEdit> grow(const CutPatch& patch, std::uint32_t stroke, std::string* reason);
  void record(const TetEdit& edit);
  std::optional<TetEdit> moveTo(std::size_t version);

  SubdivisionSettings settings_;
  /// The uncut body, then after each stroke as an edit of the version before. Copies of the history share
  /// them.
  std::vector<std::shared_ptr<const TetEdit>> versions_;
  std::size_t at_ = 0;
  CutStroke stroke_;
  std::optional<std::uint32_t> stroke_number_;  ///< of stroke_
  bool stroke_has_version_ = false;
};

}  // namespace softbody
