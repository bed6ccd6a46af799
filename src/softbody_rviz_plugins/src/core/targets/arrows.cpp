#include "targets/arrows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr int kSides = 4;
constexpr double kHeadWidth = 3.0;    // relative to the shaft
constexpr double kHeadLength = 5.0;   // relative to the shaft's width
constexpr double kLongestHead = 0.5;  // relative to the arrow

/// Rings of an arrow: start and end of the shaft, base of the head; the last vertex is the tip.
void placeArrow(const Arrow& arrow, double width, PlacedVertex* vertices) {
  const Eigen::Vector3d along = arrow.to - arrow.from;
  const double length = along.norm();
  const Eigen::Vector3d direction = length > 0.0 ? Eigen::Vector3d(along / length) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d u = direction.unitOrthogonal(), v = direction.cross(u);
  const Eigen::Vector3d neck = arrow.to - std::min(kHeadLength * width, kLongestHead * length) * direction;
  const double radius = length > 0.0 ? 0.5 * width : 0.0;
  const std::array<Eigen::Vector3d, 3> centers{arrow.from, neck, neck};
  const std::array<double, 3> radii{radius, radius, kHeadWidth * radius};
  for (int ring = 0; ring < 3; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      const double angle = 2.0 * M_PI * side / kSides;
      const Eigen::Vector3d outward = std::cos(angle) * u + std::sin(angle) * v;
      *vertices++ = {(centers[ring] + radii[ring] * outward).cast<float>(), outward.cast<float>()};
    }
  }
  *vertices = {arrow.to.cast<float>(), direction.cast<float>()};
}

}  // namespace

Arrow arrowOf(const Target& target, const Points& vertices, const Tets& tets, double stretch) {
  const Eigen::Vector3d from = positionOf(target.place, vertices, tets);
  Eigen::Vector3d pull = target.position - from;
  if (!target.normal.isZero()) pull = target.normal.dot(pull) * target.normal;
  return {from, from + stretch * pull};
}

MeshLayout layoutOfArrows(int capacity) {
  MeshLayout layout;
  layout.parts.resize(1);
  std::vector<std::uint32_t>& indices = layout.parts[0];
  layout.vertices.assign(static_cast<std::size_t>(capacity) * kVerticesPerArrow, 0);
  for (int a = 0; a < capacity; ++a) {
    const auto first = static_cast<std::uint32_t>(a * kVerticesPerArrow);
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t i = first + side, j = first + (side + 1) % kSides;
      indices.insert(indices.end(), {i, j, j + kSides, i, j + kSides, i + kSides});
      indices.insert(indices.end(), {i + 2 * kSides, j + 2 * kSides, first + 3 * kSides});
    }
  }
  return layout;
}

std::vector<PlacedVertex> placeArrows(const std::vector<Arrow>& arrows, int capacity, double width) {
  const Eigen::Vector3d anywhere = arrows.empty() ? Eigen::Vector3d::Zero().eval() : arrows[0].from;
  std::vector<PlacedVertex> vertices(static_cast<std::size_t>(capacity) * kVerticesPerArrow,
                                     {anywhere.cast<float>(), Eigen::Vector3f::UnitZ()});
  const std::size_t count = std::min(arrows.size(), static_cast<std::size_t>(capacity));
  for (std::size_t a = 0; a < count; ++a) placeArrow(arrows[a], width, &vertices[a * kVerticesPerArrow]);
  return vertices;
}

}  // namespace softbody
