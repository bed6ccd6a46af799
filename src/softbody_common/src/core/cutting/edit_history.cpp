#include "softbody_common/cutting/edit_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace softbody {
namespace {

bool samePatch(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices.rows() == b.vertices.rows() && a.triangles.rows() == b.triangles.rows() &&
         a.vertices == b.vertices && a.triangles == b.triangles;
}

/// Whether a stroke begins with all patches of another one.
bool startsWith(const Stroke& stroke, const Stroke& start) {
  return stroke.number == start.number && stroke.patches.size() >= start.patches.size() &&
         std::equal(start.patches.begin(), start.patches.end(), stroke.patches.begin(), samePatch);
}

bool sameStroke(const Stroke& a, const Stroke& b) {
  return a.patches.size() == b.patches.size() && startsWith(a, b);
}

/// Whether another patch could continue a stroke.
bool isOpen(const EditHistory& history, std::size_t stroke) {
  return history.is_open && stroke + 1 == history.in_force;
}

bool continuesStroke(const Cut& cut, const EditHistory& history) {
  return history.is_open && history.in_force > 0 &&
         history.strokes[history.in_force - 1].number == cut.stroke;
}

std::size_t trianglesOf(const Stroke& stroke) {
  std::size_t count = 0;
  for (const TriangleMesh& patch : stroke.patches) count += static_cast<std::size_t>(patch.triangles.rows());
  return count;
}

std::string refusalOfPatch(const Cut& cut, const EditHistory& history) {
  std::size_t triangles = static_cast<std::size_t>(cut.patch.triangles.rows()), cuts = 1;
  if (continuesStroke(cut, history)) triangles += trianglesOf(history.strokes[history.in_force - 1]);
  if (triangles > kMostPatchTriangles) {
    return fmt::format("its stroke would have {} triangles; allowed: up to {}; begin another stroke",
                       triangles, kMostPatchTriangles);
  }
  for (std::size_t s = 0; s < history.in_force; ++s) cuts += history.strokes[s].patches.size();
  if (cuts > kMostCuts)
    return fmt::format("the body has {} cuts, which is the limit; undo some of them, or reset it", kMostCuts);
  return "";
}

/// Builds a list of edits, each for the next revision.
class EditList {
 public:
  explicit EditList(EditHistory from) : at_(std::move(from)) {}

  const EditHistory& at() const { return at_; }
  void add(CutKind kind) { add({at_.revision + 1, 0, kind, {}}); }
  void addPatches(const Stroke& stroke, std::size_t first) {
    for (std::size_t p = first; p < stroke.patches.size(); ++p)
      add({at_.revision + 1, stroke.number, CutKind::kCut, stroke.patches[p]});
  }
  /// Makes the last stroke closed, as after an undo.
  void close() {
    add(CutKind::kUndo);
    add(CutKind::kRedo);
  }
  std::vector<Cut> take() { return std::move(edits_); }

 private:
  void add(Cut edit) {
    addEdit(edit, &at_);
    edits_.push_back(std::move(edit));
  }
  EditHistory at_;
  std::vector<Cut> edits_;
};

/// Number of first strokes that need no edit. An open stroke cannot be made from a closed one.
std::size_t commonStrokes(const EditHistory& from, const EditHistory& to) {
  std::size_t common = 0;
  while (common < std::min(from.in_force, to.in_force) &&
         sameStroke(from.strokes[common], to.strokes[common]) &&
         (isOpen(from, common) || !isOpen(to, common)))
    ++common;
  return common;
}

}  // namespace

std::string refusalOf(const Cut& edit, const EditHistory& history) {
  if (edit.revision != history.revision + 1)
    return fmt::format("its revision is {}, but the body is at revision {}", edit.revision, history.revision);
  switch (edit.kind) {
    case CutKind::kCut:
      return refusalOfPatch(edit, history);
    case CutKind::kUndo:
      return history.in_force == 0 ? "there is no cut to undo" : "";
    case CutKind::kRedo:
      return history.in_force == history.strokes.size() ? "there is no cut to redo" : "";
    case CutKind::kReset:
      return history.in_force == 0 ? "the body is not cut" : "";
  }
  return "its kind is unknown";
}

std::string refusalOf(const EditHistory& theirs, const EditHistory& own) {
  constexpr std::uint32_t kLargestLead = 1'000'000;        // nine hours of a cut in every frame
  constexpr std::uint32_t kLargestFirst = 2'000'000'000u;  // leaves as many for what follows
  const bool same_body = theirs.body == own.body;
  const std::uint32_t before = same_body ? own.revision : 0, most = same_body ? kLargestLead : kLargestFirst;
  if (theirs.revision <= before || theirs.revision - before <= most) return "";
  return fmt::format("their revision {} is more than {} after {}; start the node that sends it again",
                     theirs.revision, most, before);
}

void addEdit(const Cut& edit, EditHistory* history) {
  EditHistory& h = *history;
  h.revision = edit.revision;
  if (edit.kind != CutKind::kCut) {
    h.is_open = false;
    h.in_force = edit.kind == CutKind::kReset ? 0 : h.in_force + (edit.kind == CutKind::kRedo ? 1 : -1);
    return;
  }
  h.strokes.resize(h.in_force);
  if (!continuesStroke(edit, h)) h.strokes.push_back({edit.stroke, {}});
  h.strokes.back().patches.push_back(edit.patch);
  h.in_force = h.strokes.size();
  h.is_open = true;
}

std::vector<Cut> editsBetween(const EditHistory& from, const EditHistory& to) {
  EditList edits(from);
  std::size_t next = commonStrokes(from, to);
  if (next < to.in_force && isOpen(from, next) && startsWith(to.strokes[next], from.strokes[next])) {
    edits.addPatches(to.strokes[next], from.strokes[next].patches.size());
    ++next;
  } else if (next == 0 && from.in_force > 0) {
    edits.add(CutKind::kReset);
  } else {
    while (edits.at().in_force > next) edits.add(CutKind::kUndo);
  }
  for (; next < to.in_force; ++next) {
    const EditHistory& at = edits.at();
    const Stroke& stroke = to.strokes[next];
    if (at.in_force < at.strokes.size() && sameStroke(at.strokes[at.in_force], stroke) && !isOpen(to, next)) {
      edits.add(CutKind::kRedo);
      continue;
    }
    if (at.is_open && at.in_force > 0 && at.strokes[at.in_force - 1].number == stroke.number) edits.close();
    edits.addPatches(stroke, 0);
  }
  return edits.take();
}

bool sameEdits(const EditHistory& a, const EditHistory& b) {
  return a.in_force == b.in_force && a.is_open == b.is_open &&
         std::equal(a.strokes.begin(), a.strokes.end(), b.strokes.begin(), b.strokes.end(), sameStroke);
}

}  // namespace softbody
