#include "softbody_sim/surroundings/body_surface.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/same_matrix.h"
#include "softbody_common/geometry/surface_binding.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/object/vertex_region.h"

namespace softbody {
namespace {

constexpr double kHeldShare = 0.5;  // of a point: nearer to what is held than to what is free
constexpr double kCarries = 1e-6;   // a smaller coordinate is rounding: the vertex does not carry the point

Points transformedTo(const Eigen::Isometry3d& T_box_points, const Points& points) {
  return (points * T_box_points.linear().transpose()).rowwise() + T_box_points.translation().transpose();
}

bool sameTets(const TetTopology& a, const TetTopology& b) {
  return sameMatrix(a.tets, b.tets) && sameMatrix(a.rest_vertices, b.rest_vertices);
}

}  // namespace

BodySurface::BodySurface(MeshTopology visual, TetTopology volume)
    : visual_(std::move(visual)), volume_(std::move(volume)) {}

bool BodySurface::isIn(const TetTopology& volume) const {
  return visual_.rest_vertices.rows() == 0 || (places_ && sameTets(volume_, volume));
}

BodySurface BodySurface::in(const TetTopology& volume) const {
  BodySurface surface = *this;
  if (visual_.rest_vertices.rows() == 0) return surface;
  if (!places_) surface.places_ = bindSurface(visual_, volume_);
  if (sameTets(volume_, volume)) return surface;
  surface.places_ = transferPlaces(*surface.places_, volume_, volume);
  surface.volume_ = volume;
  return surface;
}

std::vector<int> BodySurface::verticesToHold(const Eigen::AlignedBox3d& box,
                                             const Eigen::Isometry3d& T_box_points,
                                             const Points& vertices) const {
  const Points in_box = transformedTo(T_box_points, vertices);
  std::vector<bool> inside(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    inside[static_cast<std::size_t>(v)] = box.contains(Eigen::Vector3d(in_box.row(v)));
  std::vector<bool> held = inside;
  for (const MaterialPoint& place : places_ ? *places_ : std::vector<MaterialPoint>()) {
    if (!box.contains(positionOf(place, in_box, volume_.tets))) continue;
    double share = 0.0;
    for (int corner = 0; corner < 4; ++corner)
      if (inside[static_cast<std::size_t>(volume_.tets(place.tet, corner))])
        share += place.barycentric[corner];
    if (share >= kHeldShare) continue;
    for (int corner = 0; corner < 4; ++corner)
      if (std::abs(place.barycentric[corner]) > kCarries)
        held[static_cast<std::size_t>(volume_.tets(place.tet, corner))] = true;
  }
  std::vector<int> chosen;
  for (std::size_t v = 0; v < held.size(); ++v)
    if (held[v]) chosen.push_back(static_cast<int>(v));
  return chosen;
}

std::vector<int> BodySurface::verticesAtRest(const std::string& what, const Eigen::AlignedBox3d& box,
                                             const Points& rest_vertices) const {
  const Eigen::Isometry3d at_rest = Eigen::Isometry3d::Identity();
  std::vector<int> vertices = verticesToHold(box, at_rest, rest_vertices);
  if (vertices.empty())
    throw std::invalid_argument(fmt::format("{} contains nothing of the body at rest; {}; move or enlarge it",
                                            what, nearestTo(box, at_rest, rest_vertices)));
  return vertices;
}

std::string BodySurface::nearestTo(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& T_box_points,
                                   const Points& vertices) const {
  const Points in_box = transformedTo(T_box_points, vertices);
  if (!places_) return nearestVertex(box, in_box);
  return nearestVertex(box, applyBinding(*places_, in_box, volume_.tets)) + " of the visual mesh";
}

}  // namespace softbody
