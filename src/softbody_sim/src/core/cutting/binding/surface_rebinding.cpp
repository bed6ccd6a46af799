#include "cutting/binding/surface_rebinding.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

#include "cutting/binding/side_placement.h"
#include "cutting/binding/surface_spots.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

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
      if (s + 1 >= first_.size()) return {nullptr, nullptr};
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
  Rebinding(const VisualSurface& now, const std::vector<int>& sources, const SurfaceCut& cut,
            const TetEdit& edit, const MeshState& volume)
      : now_(now),
        cut_(cut),
        edit_(edit),
        counterparts_(now.topology().rest_vertices, sources),
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
  Counterparts::Range counterpartsOf(Eigen::Index v) const {
    return counterparts_.of(cut_.vertex_sources[static_cast<std::size_t>(v)], cut_.mesh.rest_vertices.row(v));
  }
  std::vector<MaterialPoint> knownPlaces() const;
  void placeOldVertices();
  void placeNewVertices();

  const VisualSurface& now_;
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

/// Puts vertices without counterparts on the earlier surface, if they lie on it at rest.
void Rebinding::placeNewVertices() {
  std::vector<int> made;
  for (int v = 0; v < static_cast<int>(positions_.rows()); ++v) {
    if (counterpartsOf(v).size() == 0) made.push_back(v);
  }
  moveWithSurface(now_.topology(), shown_, made, cut_.mesh.rest_vertices, &positions_);
}

}  // namespace

std::vector<int> ownSources(Eigen::Index count) {
  std::vector<int> sources(static_cast<std::size_t>(count));
  std::iota(sources.begin(), sources.end(), 0);
  return sources;
}

VisualSurface rebindSurface(const VisualSurface& now, const std::vector<int>& sources, SurfaceCut cut,
                            const TetEdit& edit, const MeshState& volume) {
  TetBinding binding = Rebinding(now, sources, cut, edit, volume).binding();
  cut.mesh.revision = edit.topology.revision;
  return {std::move(cut.mesh), std::move(binding)};
}

}  // namespace softbody
