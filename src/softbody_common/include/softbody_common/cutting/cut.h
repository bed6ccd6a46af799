#pragma once

#include "softbody_common/geometry/types.h"

namespace softbody {

/// The kind of an edit.
enum class CutKind : std::uint8_t { kCut = 0, kUndo = 1, kRedo = 2, kReset = 3 };

/// A topological edit, which every model of the body applies by itself (softbody_msgs/Cut without its
/// header).
struct Cut {
  std::uint32_t revision = 0;  ///< of the topologies after the edit
  std::uint32_t stroke = 0;    ///< all cuts of one stroke of the blade have the same number
  CutKind kind = CutKind::kCut;
  TriangleMesh patch;  ///< in rest space [m]; empty unless kind is kCut
};

}  // namespace softbody
