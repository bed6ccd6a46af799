#pragma once

#include <optional>
#include <vector>

#include "colors/color.h"
#include "softbody_common/geometry/types.h"
#include "surface/mesh_layout.h"
#include "targets/arrows.h"
#include "tets/cutaway.h"
#include "tets/tet_values.h"

namespace softbody {

/// What the colours of the tets show.
enum class TetColoring {
  kOneColor,
  kPiece,
  kQuality,            ///< 1 regular, 0 flat
  kStrain,             ///< relative
  kStandardDeviation,  ///< mean of the tet's vertices [m]
  kConfidence          ///< mean of the tet's vertices
};

bool showsValues(TetColoring coloring);

/// The tets and their newest state, as they are drawn.
class TetsModel {
 public:
  explicit TetsModel(TetTopology topology);

  void cutAway(const CutawayPlane& plane);
  /// @throw std::invalid_argument as requireDrawable; the model is then as before.
  void setState(MeshState state);

  const TetTopology& topology() const { return topology_; }
  const MeshLayout& layout() const { return layout_; }
  const MeshLayout& surfaceLayout() const { return surface_layout_; }
  const std::optional<MeshState>& state() const { return state_; }

  /// These need a state.
  std::vector<PlacedVertex> placed() const;
  std::vector<PlacedVertex> placedSurface() const;
  /// Per tet; empty if the state has no such values, or if the colours show none.
  std::vector<float> values(TetColoring coloring) const;
  /// Per drawn vertex. @param values per tet, as values() gives them.
  std::vector<Color> painted(TetColoring coloring, Color one_color, ColorMap map,
                             const std::vector<float>& values, double maximum) const;
  /// Arrows of the targets of one kind; targets in tets that do not exist are left out, as
  /// are arrows of no sensible length.
  std::vector<Arrow> arrows(const TargetSet& targets, TargetKind kind, double stretch) const;

 private:
  TetTopology topology_;
  TetStrain strain_;
  CutawayFaces faces_;
  MeshLayout layout_, surface_layout_;
  std::optional<MeshState> state_;
};

}  // namespace softbody
