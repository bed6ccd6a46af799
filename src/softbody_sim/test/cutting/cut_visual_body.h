#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/cutting/cut_history.h"
#include "core/cutting/surface_history.h"
#include "softbody_common/tet_locator.h"
#include "visual_sponge.h"

namespace softbody::testing {

constexpr double kRounding = 2e-8;  ///< [m] of coordinates in single precision

inline MeshState stateOf(const TetTopology& volume, const Points& vertices) {
  MeshState state;
  state.revision = volume.revision;
  state.vertices = vertices;
  state.confidence.assign(static_cast<std::size_t>(vertices.rows()), 1.0f);
  return state;
}

/// Bent, twisted and a little uneven, by centimetres.
inline Points deformed(const Points& rest) {
  Points points = rest;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const double x = rest(v, 0), y = rest(v, 1), z = rest(v, 2);
    points.row(v) << x - 0.5 * z * x, y + 0.004 * std::sin(40.0 * x) - 2.0 * z * x,
        z + 3.0 * x * x + 2.0 * x * y;
  }
  return points;
}

/// A body whose tets and visual mesh are cut together.
struct CutBody {
  explicit CutBody(const TetTopology& uncut = sponge(), const MeshTopology& visual = visualSponge())
      : tets(uncut), surface(VisualSurface(visual, uncut)), vertices(deformed(uncut.rest_vertices)) {}

  MeshState state() const { return stateOf(tets.topology(), vertices); }
  Points shown() const { return surface.surface().apply(state()).vertices; }
  Points atRest() const {
    return surface.surface().apply(stateOf(tets.topology(), tets.topology().rest_vertices)).vertices;
  }

  /// Cuts the tets where the mesh can be cut. @return whether there was a cut.
  bool cut(const CutPatch& patch, std::uint32_t stroke) {
    const SurfaceCut mesh = surface.preview(patch, stroke);
    if (mesh.outcome != CutOutcome::kCut) return false;
    const TetTopology before = tets.topology();
    std::string reason;
    const auto edit = tets.cut(patch, stroke, &reason);
    if (!edit) {
      surface.advance(patch, stroke);
      return false;
    }
    surface.cut(patch, stroke, mesh, *edit, stateOf(before, vertices));
    vertices = applyBinding(edit->vertex_origins, vertices, before.tets);
    return true;
  }

  CutHistory tets;
  SurfaceHistory surface;
  Points vertices;  ///< of the tets, deformed
};

/// Vertices that both meshes have, by the input file and by their places: kept ones and earlier copies.
inline double worstJump(const Points& shown_before, const MeshTopology& before, const Points& shown_after,
                        const MeshTopology& after) {
  std::multimap<std::array<double, 3>, Eigen::Index> places;
  for (Eigen::Index v = 0; v < before.rest_vertices.rows(); ++v) {
    places.insert({{before.rest_vertices(v, 0), before.rest_vertices(v, 1), before.rest_vertices(v, 2)}, v});
  }
  double worst = 0.0;
  for (Eigen::Index v = 0; v < after.rest_vertices.rows(); ++v) {
    const auto [first, last] =
        places.equal_range({after.rest_vertices(v, 0), after.rest_vertices(v, 1), after.rest_vertices(v, 2)});
    if (first == last) continue;
    double jump = 1.0;
    for (auto entry = first; entry != last; ++entry) {
      jump = std::min(jump, (shown_after.row(v) - shown_before.row(entry->second)).norm());
    }
    worst = std::max(worst, jump);
  }
  return worst;
}

}  // namespace softbody::testing
