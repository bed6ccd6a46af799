#pragma once

#include <cstddef>

#include "softbody_common/cutting/edit_history.h"

/// The versions of a body that undo and redo return to: the uncut body, then one after each stroke. They are
/// a cache: a version that was dropped is made again from the patches of its strokes. A Body has
///   edits()          its EditHistory
///   has(k), bytes(k), drop(k)   a version, by its number of strokes
///   upTo(k)          a copy that ends with version k, with closed strokes
///   cutStroke(s)     makes a stroke that some body has made before
///   takeVersions(b)  takes the versions that this body lacks from another one with the same strokes
namespace softbody {

/// Whether a version may be dropped: not the uncut body, the present one, or the one before its stroke.
inline bool mayDrop(std::size_t version, std::size_t present) {
  return version != 0 && version != present && version + 1 != present;
}

/// Drops versions until the others that may be dropped need at most `limit` bytes, those furthest from the
/// present one first.
template <typename Body>
void dropVersions(std::size_t limit, Body* body) {
  const std::size_t present = body->edits().in_force, count = body->edits().strokes.size() + 1;
  const auto distance = [present](std::size_t k) { return k < present ? present - k : k - present; };
  std::size_t used = 0;
  for (std::size_t k = 0; k < count; ++k) used += mayDrop(k, present) && body->has(k) ? body->bytes(k) : 0;
  while (used > limit) {
    std::size_t furthest = present;
    for (std::size_t k = 0; k < count; ++k) {
      if (mayDrop(k, present) && body->has(k) && distance(k) > distance(furthest)) furthest = k;
    }
    used -= body->bytes(furthest);
    body->drop(furthest);
  }
}

/// Makes a version that was dropped. @param limit as of dropVersions.
template <typename Body>
void restoreVersion(std::size_t version, std::size_t limit, Body* body) {
  std::size_t start = version;
  while (!body->has(start)) --start;
  Body again = body->upTo(start);
  for (std::size_t k = start; k < version; ++k) {
    again.cutStroke(body->edits().strokes[k]);
    dropVersions(limit, &again);
  }
  body->takeVersions(again);
}

/// The version that an edit returns to. A cut and an impossible edit return to none: the present version.
inline std::size_t versionAfter(const Cut& edit, const EditHistory& edits) {
  if (edit.kind == CutKind::kReset) return 0;
  if (edit.kind == CutKind::kUndo && edits.in_force > 0) return edits.in_force - 1;
  if (edit.kind == CutKind::kRedo && edits.in_force < edits.strokes.size()) return edits.in_force + 1;
  return edits.in_force;
}

/// Drops versions if an edit returns to one that has to be made again, because that needs their memory. Call
/// it before the body is copied: copies share versions. @param edit the next one of `body`.
template <typename Body>
void makeRoomFor(const Cut& edit, Body* body) {
  if (!body->has(versionAfter(edit, body->edits()))) dropVersions(0, body);
}

/// Number of strokes, in force or undone, whose versions were dropped.
template <typename Body>
std::size_t droppedVersions(const Body& body) {
  std::size_t dropped = 0;
  for (std::size_t k = 0; k <= body.edits().strokes.size(); ++k) dropped += body.has(k) ? 0 : 1;
  return dropped;
}

}  // namespace softbody
