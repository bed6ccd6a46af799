#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "cutting/binding/surface_history.h"
#include "cutting/volume/edited_volume.h"
#include "softbody_common/cutting/cut.h"

namespace softbody {

/// Bounds of a body that is cut.
struct CutLimits {
  std::size_t pieces = 0;
  std::size_t undo_bytes = 0;
};

/// @throw std::invalid_argument if a cut leaves too many.
void requireFewPieces(const MeshTopology& mesh, const CutLimits& limits);

/// The state that cuts change. Copies share everything that an edit does not change.
struct CutModels {
  CutHistory tets;
  SurfaceHistory surface;

  bool cut(const Cut& cut, const MeshState& state, const CutLimits& limits, std::string* reason);
  bool move(const Cut& cut, const CutLimits& limits, std::string* reason);
  /// Cuts the tets, and the visual mesh where that is possible. The body is at rest.
  void cutAtRest(const CutPatch& patch, std::uint32_t stroke);
  void adopt(const EditHistory& edits, const CutLimits& limits);

  // The versions, as undo_versions.h uses them.
  const EditHistory& edits() const { return tets.edits(); }
  bool has(std::size_t version) const { return tets.has(version) && surface.has(version); }
  std::size_t bytes(std::size_t version) const { return tets.bytes(version) + surface.bytes(version); }
  void drop(std::size_t version) { tets.drop(version), surface.drop(version); }
  CutModels upTo(std::size_t version) const { return {tets.upTo(version), surface.upTo(version)}; }
  void cutStroke(const Stroke& stroke);
  void takeVersions(const CutModels& other);
};

}  // namespace softbody
