#include "cutting/binding/surface_rebinding.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

#include "cutting/binding/side_placement.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"

namespace softbody {
namespace {

/// The earlier vertices that correspond to a vertex after the cut: those with the same source. Vertices made
/// by the cut are found by their rest positions. On the two walls of a cut there are several.
class Counterparts {
 public:
  struct Range {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    std::ptrdiff_t size() const { return last - first; }
  };

  Counterparts(const Points& vertices, const std::vector<int>& sources) {
    const int count = sources.empty() ? 0 : *std::max_element(sources.begin(), sources.end()) + 1;
    first_.resize(static_cast<std::size_t>(count) + 1, 0);
    for (std::size_t v = 0; v < sources.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      if (sources[v] >= 0)
        ++first_[static_cast<std::size_t>(sources[v])];
      else
        made_[{vertices(row, 0), vertices(row, 1), vertices(row, 2)}].push_back(static_cast<int>(v));
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    kept_.resize(static_cast<std::size_t>(first_.back()));
    for (std::size_t v = sources.size(); v-- > 0;) {
      if (sources[v] < 0) continue;
      kept_[static_cast<std::size_t>(--first_[static_cast<std::size_t>(sources[v])])] = static_cast<int>(v);
    }
  }

  Range of(int source, const Eigen::RowVector3d& rest) const {
    if (source >= 0) {
      const auto s = static_cast<std::size_t>(source);
      return {kept_.data() + first_[s], kept_.data() + first_[s + 1]};
    }
    const auto found = made_.find({rest[0], rest[1], rest[2]});
    if (found == made_.end()) return {nullptr, nullptr};
    return {found->second.data(), found->second.data() + found->second.size()};
  }

 private:
  std::vector<int> first_, kept_;  ///< vertices by their sources; those of source s begin at first_[s]
  std::map<std::array<double, 3>, std::vector<int>> made_;
};

class Rebinding {
 public:
  Rebinding(const VisualSurface& now, const MeshSources& sources, const SurfaceCut& cut, const TetEdit& edit,
            const MeshState& volume)
      : now_(now),
        sources_(sources),
        cut_(cut),
        edit_(edit),
        counterparts_(now.topology().rest_vertices, sources.vertices),
        shown_(now.apply(volume).vertices) {
    const TetTopology& before = now.binding().volume();
    vertices_ = applyBinding(edit.vertex_origins, volume.vertices, before.tets);
    places_ = placesByCutSide(cut, knownPlaces(), before, edit);
    positions_ = applyBinding(places_, vertices_, edit.topology.tets);
  }

  TetBinding binding() {
    placeOldVertices();
    placeNewVertices();
    TetBinding binding(edit_.topology, std::move(places_));
    binding.correctTo(vertices_, positions_);
    return binding;
  }

 private:
  /// A position of a vertex on a triangle of the earlier surface.
  struct Spot {
    double outside = 0.0;         ///< distance beyond the triangle's border, in barycentric coordinates
    Eigen::RowVector3d position;  ///< in the given state
    double distance = 0.0;        ///< from the position by the vertex's tet
    bool isBetterThan(const Spot& other) const {
      constexpr double kRounding = 1e-3;
      if (std::max(outside, other.outside) > kRounding) return outside < other.outside;
      return distance < other.distance;
    }
  };

  Counterparts::Range counterpartsOf(Eigen::Index v) const {
    return counterparts_.of(cut_.vertex_sources[static_cast<std::size_t>(v)], cut_.mesh.rest_vertices.row(v));
  }
  std::vector<MaterialPoint> knownPlaces() const;
  void placeOldVertices();
  std::vector<std::vector<int>> newVerticesBySource() const;
  void placeNewVertices();
  Spot spotOn(const Eigen::RowVector3i& triangle, int v) const;

  const VisualSurface& now_;
  const MeshSources& sources_;
  const SurfaceCut& cut_;
  const TetEdit& edit_;
  Counterparts counterparts_;
  Points shown_;     ///< vertices of the earlier surface, in the given state
  Points vertices_;  ///< of the tets after the edit, likewise
  std::vector<MaterialPoint> places_;
  Points positions_;
};

std::vector<MaterialPoint> Rebinding::knownPlaces() const {
  std::vector<MaterialPoint> known(cut_.vertex_sources.size());
  for (std::size_t v = 0; v < known.size(); ++v) {
    const Counterparts::Range candidates = counterpartsOf(static_cast<Eigen::Index>(v));
    if (candidates.size() == 1 && cut_.vertex_sources[v] >= 0) {
      known[v] = now_.binding().places()[static_cast<std::size_t>(*candidates.begin())];
    }
  }
  return known;
}

/// Of several counterparts, takes the one nearest to the position by the vertex's tet, which is on its side.
void Rebinding::placeOldVertices() {
  for (Eigen::Index v = 0; v < positions_.rows(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    Eigen::RowVector3d position = positions_.row(v);
    for (const int candidate : counterpartsOf(v)) {
      const double distance = (shown_.row(candidate) - positions_.row(v)).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      position = shown_.row(candidate);
    }
    positions_.row(v) = position;
  }
}

/// Per triangle of the mesh before the stroke, the new vertices on it.
std::vector<std::vector<int>> Rebinding::newVerticesBySource() const {
  std::vector<std::vector<int>> made;
  for (Eigen::Index t = 0; t < cut_.mesh.triangles.rows(); ++t) {
    const int source = cut_.triangle_sources[static_cast<std::size_t>(t)];
    if (source < 0) continue;
    for (const int v : cut_.mesh.triangles.row(t)) {
      if (cut_.vertex_sources[static_cast<std::size_t>(v)] >= 0 || counterpartsOf(v).size() > 0) continue;
      if (made.size() <= static_cast<std::size_t>(source)) made.resize(static_cast<std::size_t>(source) + 1);
      made[static_cast<std::size_t>(source)].push_back(v);
    }
  }
  return made;
}

/// Puts each new vertex on the earlier triangle that contains it at rest. Of two triangles beside a slit,
/// takes the one nearest to the position by the vertex's tet.
void Rebinding::placeNewVertices() {
  const MeshTopology& before = now_.topology();
  const std::vector<std::vector<int>> made = newVerticesBySource();
  std::map<int, Spot> spots;
  for (Eigen::Index t = 0; t < before.triangles.rows(); ++t) {
    const auto source = static_cast<std::size_t>(sources_.triangles[static_cast<std::size_t>(t)]);
    if (source >= made.size()) continue;
    for (const int v : made[source]) {
      const Spot spot = spotOn(before.triangles.row(t), v);
      const auto [entry, is_first] = spots.emplace(v, spot);
      if (!is_first && spot.isBetterThan(entry->second)) entry->second = spot;
    }
  }
  for (const auto& [v, spot] : spots) positions_.row(v) = spot.position;
}

Rebinding::Spot Rebinding::spotOn(const Eigen::RowVector3i& triangle, int v) const {
  const Points& rest = now_.topology().rest_vertices;
  Eigen::Matrix<double, 3, 2> edges;
  edges << (rest.row(triangle[1]) - rest.row(triangle[0])).transpose(),
      (rest.row(triangle[2]) - rest.row(triangle[0])).transpose();
  const Eigen::Vector3d offset = (cut_.mesh.rest_vertices.row(v) - rest.row(triangle[0])).transpose();
  const Eigen::Vector2d w = edges.colPivHouseholderQr().solve(offset);
  Spot spot;
  spot.outside = std::max({0.0, -w[0], -w[1], w[0] + w[1] - 1.0});
  spot.position = (1.0 - w.sum()) * shown_.row(triangle[0]) + w[0] * shown_.row(triangle[1]) +
                  w[1] * shown_.row(triangle[2]);
  spot.distance = (spot.position - positions_.row(v)).norm();
  return spot;
}

}  // namespace

MeshSources ownSources(const MeshTopology& mesh) {
  MeshSources sources;
  sources.vertices.resize(static_cast<std::size_t>(mesh.rest_vertices.rows()));
  sources.triangles.resize(static_cast<std::size_t>(mesh.triangles.rows()));
  std::iota(sources.vertices.begin(), sources.vertices.end(), 0);
  std::iota(sources.triangles.begin(), sources.triangles.end(), 0);
  return sources;
}

VisualSurface rebindSurface(const VisualSurface& now, const MeshSources& sources, SurfaceCut cut,
                            const TetEdit& edit, const MeshState& volume) {
  TetBinding binding = Rebinding(now, sources, cut, edit, volume).binding();
  cut.mesh.revision = edit.topology.revision;
  return {std::move(cut.mesh), std::move(binding)};
}

}  // namespace softbody
