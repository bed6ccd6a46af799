#include "tets/tets_model.h"

#include <limits>
#include <utility>

#include "body/state_check.h"
#include "softbody_common/geometry/plausibility.h"

namespace softbody {
namespace {

std::vector<float> meansOfTets(const Tets& tets, const std::vector<float>& of_vertices) {
  if (of_vertices.empty()) return {};
  std::vector<float> means;
  for (const auto& tet : tets.rowwise()) {
    float sum = 0.0f;
    for (const int vertex : tet) sum += of_vertices[vertex];
    means.push_back(0.25f * sum);
  }
  return means;
}

}  // namespace

bool showsValues(TetColoring coloring) { return coloring >= TetColoring::kQuality; }

TetsModel::TetsModel(TetTopology topology)
    : topology_(std::move(topology)), strain_(topology_), surface_layout_(layoutOfFacets(topology_.surface)) {
  cutAway({});
}

void TetsModel::cutAway(const CutawayPlane& plane) {
  faces_ = cutawayFaces(topology_, plane);
  layout_ = layoutOfFacets(faces_.triangles);
}

void TetsModel::setState(MeshState state) {
  requireDrawable(state, topology_.revision, topology_.rest_vertices);
  state_ = std::move(state);
}

std::vector<PlacedVertex> TetsModel::placed() const {
  return place(layout_, state_->vertices, faces_.triangles);
}

std::vector<PlacedVertex> TetsModel::placedSurface() const {
  return place(surface_layout_, state_->vertices, topology_.surface);
}

std::vector<float> TetsModel::values(TetColoring coloring) const {
  switch (coloring) {
    case TetColoring::kQuality:
      return tetQualities(state_->vertices, topology_.tets);
    case TetColoring::kStrain:
      return strain_.at(state_->vertices);
    case TetColoring::kStandardDeviation:
      return meansOfTets(topology_.tets, state_->standard_deviation);
    case TetColoring::kConfidence:
      return meansOfTets(topology_.tets, state_->confidence);
    default:
      return {};
  }
}

std::vector<Color> TetsModel::painted(TetColoring coloring, Color one_color, ColorMap map,
                                      const std::vector<float>& values, double maximum) const {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::vector<Color> colors;
  colors.reserve(layout_.triangles.size());
  for (const int triangle : layout_.triangles) {
    const int tet = faces_.tets[triangle];
    if (showsValues(coloring)) {
      colors.push_back(colorOf(map, (values.empty() ? kNone : values[tet]) / maximum));
    } else {
      colors.push_back(coloring == TetColoring::kPiece ? pieceColor(topology_.tet_pieces[tet]) : one_color);
    }
  }
  return colors;
}

std::vector<Arrow> TetsModel::arrows(const TargetSet& targets, TargetKind kind, double stretch) const {
  std::vector<Arrow> arrows;
  for (const Target& target : targets.targets) {
    if (target.kind != kind || target.place.tet < 0 || target.place.tet >= topology_.tets.rows()) continue;
    const Arrow arrow = arrowOf(target, state_->vertices, topology_.tets, stretch);
    if (isPlausible(arrow.from) && isPlausible(arrow.to)) arrows.push_back(arrow);
  }
  return arrows;
}

}  // namespace softbody
