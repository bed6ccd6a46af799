#pragma once

#include <optional>
#include <vector>

#include "colors/color.h"
#include "softbody_common/geometry/types.h"
#include "softbody_common/images/vertex_colors.h"
#include "surface/mesh_layout.h"
#include "surface/strain.h"

namespace softbody {

/// What the colours of a surface show.
enum class SurfaceColoring {
  kTexture,  ///< those of the mesh file; else white, for an image to multiply
  kOneColor,
  kPiece,
  kStandardDeviation,  ///< [m]
  kConfidence,         ///< 0 to 1
  kDistanceFromRest,   ///< [m]
  kStrain              ///< relative
};

struct SurfacePaint {
  SurfaceColoring coloring = SurfaceColoring::kOneColor;
  Color skin{225, 150, 90, 255};
  Color cut{190, 45, 45, 255};  ///< faces that fill cuts, unless colours show values
  ColorMap map = ColorMap::kViridis;
  double maximum = 1.0;   ///< value at the end of the colour map
  VertexColors own = {};  ///< of the mesh's vertices, or empty
};

/// True if colours show a number per vertex.
bool showsValues(SurfaceColoring coloring);

/// A visual mesh and its newest state, as it is drawn.
class SurfaceModel {
 public:
  /// @param crease_angle edges that are sharper at rest stay sharp [rad].
  SurfaceModel(MeshTopology topology, double crease_angle);

  /// @throw std::invalid_argument as requireDrawable; the model is then as before.
  void setState(MeshState state);

  const MeshTopology& topology() const { return topology_; }
  const MeshLayout& layout() const { return layout_; }
  const std::optional<MeshState>& state() const { return state_; }

  /// These need a state.
  std::vector<PlacedVertex> placed() const;
  /// Per vertex of the mesh; empty if the state has no such values, or if the colours show none.
  std::vector<float> values(SurfaceColoring coloring) const;
  /// Per drawn vertex. @param values as values() gives them.
  std::vector<Color> painted(const SurfacePaint& paint, const std::vector<float>& values) const;

  /// Whether the mesh has no boundary, so that nobody sees it from inside.
  bool isClosed() const { return closed_; }
  /// The piece of each vertex.
  const std::vector<std::uint32_t>& vertexPieces() const { return pieces_; }

 private:
  MeshTopology topology_;
  MeshLayout layout_;
  SurfaceStrain strain_;
  bool closed_;
  std::vector<std::uint32_t> pieces_;
  std::optional<MeshState> state_;
};

}  // namespace softbody
