#include "surface/surface_model.h"

#include <limits>
#include <utility>

#include "body/state_check.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

namespace {

constexpr Color kWhite{255, 255, 255, 255};

Color toColor(const VertexColors::value_type& rgb) { return {rgb[0], rgb[1], rgb[2], 255}; }

}  // namespace

bool showsValues(SurfaceColoring coloring) { return coloring >= SurfaceColoring::kStandardDeviation; }

SurfaceModel::SurfaceModel(MeshTopology topology, double crease_angle)
    : topology_(std::move(topology)),
      layout_(layoutOfSurface(topology_, crease_angle)),
      strain_(topology_),
      closed_(softbody::isClosed(topology_.triangles)),
      pieces_(softbody::vertexPieces(topology_.triangles, topology_.triangle_pieces,
                                     topology_.rest_vertices.rows())) {}

void SurfaceModel::setState(MeshState state) {
  requireDrawable(state, topology_.revision, topology_.rest_vertices);
  state_ = std::move(state);
}

std::vector<PlacedVertex> SurfaceModel::placed() const {
  return place(layout_, state_->vertices, topology_.triangles);
}

std::vector<float> SurfaceModel::values(SurfaceColoring coloring) const {
  switch (coloring) {
    case SurfaceColoring::kStandardDeviation:
      return state_->standard_deviation;
    case SurfaceColoring::kConfidence:
      return state_->confidence;
    case SurfaceColoring::kDistanceFromRest:
      return distancesFromRest(topology_, state_->vertices);
    case SurfaceColoring::kStrain:
      return strain_.at(state_->vertices);
    default:
      return {};
  }
}

std::vector<Color> SurfaceModel::painted(const SurfacePaint& paint, const std::vector<float>& values) const {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::vector<Color> colors(layout_.vertices.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const int triangle = layout_.triangles[i];
    if (showsValues(paint.coloring)) {
      colors[i] = colorOf(paint.map, (values.empty() ? kNone : values[layout_.vertices[i]]) / paint.maximum);
    } else if (topology_.cut[triangle]) {
      colors[i] = paint.cut;
    } else if (paint.coloring == SurfaceColoring::kPiece) {
      colors[i] = pieceColor(topology_.triangle_pieces[triangle]);
    } else if (paint.coloring == SurfaceColoring::kTexture) {
      colors[i] = paint.own.empty() ? kWhite : toColor(paint.own[layout_.vertices[i]]);
    } else {
      colors[i] = paint.skin;
    }
  }
  return colors;
}

}  // namespace softbody
