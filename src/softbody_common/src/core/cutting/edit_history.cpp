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

bool sameStroke(const Stroke& a, const Stroke& b) {
  return a.number == b.number &&
         std::equal(a.patches.begin(), a.patches.end(), b.patches.begin(), b.patches.end(), samePatch);
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

std::optional<Cut> nextEdit(const EditHistory& from, const EditHistory& to) {
  Cut cut{from.revision + 1, 0, CutKind::kCut, {}};
  if (to.in_force > 0) {
    cut.stroke = to.strokes[to.in_force - 1].number;
    cut.patch = to.strokes[to.in_force - 1].patches.back();
  }
  const Cut none{cut.revision, 0, CutKind::kUndo, {}};
  for (const CutKind kind : {CutKind::kCut, CutKind::kUndo, CutKind::kRedo, CutKind::kReset}) {
    Cut edit = kind == CutKind::kCut ? cut : none;
    edit.kind = kind;
    EditHistory after = from;
    if (edit.revision != to.revision || !refusalOf(edit, from).empty()) continue;
    addEdit(edit, &after);
    if (sameEdits(after, to)) return edit;
  }
  return std::nullopt;
}

std::size_t commonStrokes(const EditHistory& a, const EditHistory& b) {
  const auto first_other =
      std::mismatch(a.strokes.begin(), a.strokes.end(), b.strokes.begin(), b.strokes.end(), sameStroke);
  return static_cast<std::size_t>(first_other.first - a.strokes.begin());
}

bool sameEdits(const EditHistory& a, const EditHistory& b) {
  return a.in_force == b.in_force && a.is_open == b.is_open &&
         std::equal(a.strokes.begin(), a.strokes.end(), b.strokes.begin(), b.strokes.end(), sameStroke);
}

}  // namespace softbody
