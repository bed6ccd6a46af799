#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/cutting/cut.h"

namespace softbody {

/// Most triangles of one patch, and of all patches of a stroke: a cut takes time for each of them.
constexpr std::size_t kMostPatchTriangles = 20'000;
/// Most patches of all strokes.
constexpr std::size_t kMostCuts = 10'000;

/// One motion of the blade through the body. All its patches are undone together.
struct Stroke {
  std::uint32_t number = 0;
  std::vector<TriangleMesh> patches;  ///< in rest space [m], in the order of the cuts
};

/// The edits of a body (softbody_msgs/CutHistory without header and uncut body). Every model of the body
/// follows from its uncut model and this list.
struct EditHistory {
  std::uint64_t body = 0;       ///< identifies the uncut body; 0: just started, not edited by anybody
  std::uint32_t revision = 0;   ///< of the models after the edits
  std::vector<Stroke> strokes;  ///< first those in force, then the undone ones, the next to redo first
  std::size_t in_force = 0;     ///< number of strokes in force
  bool is_open = false;         ///< a patch with the number of the last stroke in force continues it
};

/// Why an edit is not possible; empty if it is.
std::string refusalOf(const Cut& edit, const EditHistory& history);

/// Why the edits that another node sends cannot be taken over; empty if they can. A revision is never taken
/// back, so one wrong message must not use up the numbers.
std::string refusalOf(const EditHistory& theirs, const EditHistory& own);

/// Adds a possible edit. A cut discards the undone strokes.
void addEdit(const Cut& edit, EditHistory* history);

/// The edit that leads from one history to the next; nothing if more than one does.
std::optional<Cut> nextEdit(const EditHistory& from, const EditHistory& to);

/// Number of first strokes, in force or undone, that two histories share.
std::size_t commonStrokes(const EditHistory& a, const EditHistory& b);

/// Whether the same strokes are in force and undone. Body and revision may differ.
bool sameEdits(const EditHistory& a, const EditHistory& b);

}  // namespace softbody
