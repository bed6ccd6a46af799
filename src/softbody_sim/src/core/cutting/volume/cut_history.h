#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cutting/volume/tet_cutter.h"

namespace softbody {

/// The tets of a body through strokes of the blade, undo and redo. A stroke is one undo step, whatever the
/// number of its cuts. Undo restores the earlier topology bit for bit, except for its revision, which only
/// increases.
class CutHistory {
 public:
  explicit CutHistory(const TetTopology& uncut, const SubdivisionSettings& settings = {});

  const TetTopology& topology() const { return versions_[at_]->topology; }
  /// Per triangle of the topology's surface: true if it was inside the uncut body.
  const std::vector<bool>& cut() const { return versions_[at_]->cut; }
  /// The topology and the edit that made it from the previous version. The uncut body has an edit without
  /// changes.
  std::shared_ptr<const TetEdit> version() const { return versions_[at_]; }

  /// Cuts along a patch. A new stroke begins if the stroke number differs from that of the last call. After
  /// undo, redo or reset, any number begins a new stroke. If there is no edit, only the progress of the
  /// stroke changes, and `reason` says why. After an edit, undone strokes cannot be redone.
  /// @throw std::invalid_argument as cutTets.
  std::optional<TetEdit> cut(const CutPatch& patch, std::uint32_t stroke, std::string* reason);

  /// Like cut. A patch that crosses no tet is also an edit, which changes only the revision: it can cut the
  /// finer visual mesh.
  TetEdit cutOrAdvance(const CutPatch& patch, std::uint32_t stroke);

  /// The result of cut, without changing anything.
  std::optional<TetEdit> preview(const CutPatch& patch, std::uint32_t stroke, std::string* reason) const;

  std::optional<TetEdit> undo();   ///< nothing if there is no stroke to undo
  std::optional<TetEdit> redo();   ///< nothing if there is no stroke to redo
  std::optional<TetEdit> reset();  ///< to the uncut body; strokes can be redone one by one

 private:
  CutStroke strokeFor(std::uint32_t number) const;
  std::optional<TetEdit> grow(const CutPatch& patch, std::uint32_t stroke, std::string* reason);
  void record(const TetEdit& edit);
  std::optional<TetEdit> moveTo(std::size_t version);

  SubdivisionSettings settings_;
  /// The uncut body, then one version per stroke, as an edit of the previous one. Copies of the history share
  /// them.
  std::vector<std::shared_ptr<const TetEdit>> versions_;
  std::size_t at_ = 0;
  CutStroke stroke_;
  std::optional<std::uint32_t> stroke_number_;  ///< of stroke_
  bool stroke_has_version_ = false;
};

}  // namespace softbody
