#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cutting/volume/tet_cutter.h"
#include "softbody_common/cutting/edit_history.h"

namespace softbody {

/// The tets of a body through strokes of the blade, undo and redo. A stroke is one undo step, whatever the
/// number of its cuts. Undo restores the earlier topology bit for bit, except for its revision, which only
/// increases.
class CutHistory {
 public:
  explicit CutHistory(const TetTopology& uncut, const SubdivisionSettings& settings = {});

  const TetTopology& topology() const { return present().edit.topology; }
  /// Per triangle of the topology's surface: true if it was inside the uncut body.
  const std::vector<bool>& cut() const { return present().edit.cut; }
  /// The topology and the edit that made it from the previous version. The uncut body has an edit without
  /// changes.
  std::shared_ptr<const TetEdit> version() const;
  /// The uncut body; its revision may be a later one.
  const TetTopology& uncut() const { return versions_.front()->edit.topology; }
  /// All edits since the uncut body.
  const EditHistory& edits() const { return edits_; }

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

  /// Nothing if there is no stroke to undo or redo. @throw std::logic_error if the version was dropped.
  std::optional<TetEdit> undo();
  std::optional<TetEdit> redo();
  std::optional<TetEdit> reset();  ///< to the uncut body; strokes can be redone one by one

  /// Takes over revision, body and undone strokes of a history with the same strokes in force.
  void take(const EditHistory& edits);
  void setBody(std::uint64_t body) { edits_.body = body; }

  // The versions, as undo_versions.h uses them.
  bool has(std::size_t version) const { return versions_[version] != nullptr; }
  std::size_t bytes(std::size_t version) const { return versions_[version]->bytes; }
  void drop(std::size_t version) { versions_[version].reset(); }
  CutHistory upTo(std::size_t version) const;
  void cutStroke(const Stroke& stroke);
  void closeStroke();
  void takeVersions(const CutHistory& other);

 private:
  struct Version {
    TetEdit edit;                 ///< of the previous version
    std::vector<int> uncut_tets;  ///< per tet, the tet of the uncut body that contains it
    std::size_t bytes = 0;
  };
  static std::shared_ptr<const Version> makeVersion(TetEdit edit, std::vector<int> uncut_tets);

  const Version& present() const { return *versions_[edits_.in_force]; }
  CutStroke strokeFor(std::uint32_t number) const;
  std::optional<TetEdit> grow(const CutPatch& patch, std::uint32_t stroke, std::string* reason);
  void record(const TetEdit& edit, const CutPatch& patch);
  std::optional<TetEdit> moveTo(std::size_t version, CutKind kind);
  void setRevision(std::uint32_t revision);

  SubdivisionSettings settings_;
  EditHistory edits_;
  /// The uncut body, then one version per stroke; null: dropped. Copies of the history share them.
  std::vector<std::shared_ptr<const Version>> versions_;
  CutStroke stroke_;
  std::optional<std::uint32_t> stroke_number_;  ///< of stroke_
};

}  // namespace softbody
