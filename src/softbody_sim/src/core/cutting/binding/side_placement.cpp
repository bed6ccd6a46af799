#include "cutting/binding/side_placement.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

#include "cutting/binding/tet_walk.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

/// Per vertex after the edit: true if it is new, or was duplicated by the crack.
std::vector<bool> crackVertices(const TetTopology& before, const TetEdit& edit) {
  const auto count = static_cast<std::size_t>(before.rest_vertices.rows());
  std::vector<bool> crack(edit.vertex_origins.size(), true);
  std::fill_n(crack.begin(), count, false);
  for (std::size_t v = count; v < crack.size(); ++v) {
    const MaterialPoint& origin = edit.vertex_origins[v];
    for (int k = 0; k < 4; ++k) {
      if (origin.barycentric[k] == 1.0) crack[static_cast<std::size_t>(before.tets(origin.tet, k))] = true;
    }
  }
  return crack;
}

std::size_t pieceCountOf(const std::vector<std::uint32_t>& pieces) {
  return pieces.empty() ? 0 : *std::max_element(pieces.begin(), pieces.end()) + 1;
}

class SidePlacement {
 public:
  SidePlacement(const SurfaceCut& surface, const TetTopology& before, const TetEdit& edit)
      : surface_(surface),
        mesh_(surface.mesh),
        before_(before),
        edit_(edit),
        walk_(edit.topology.rest_vertices, edit.topology.tets),
        mesh_pieces_(static_cast<std::size_t>(mesh_.rest_vertices.rows())),
        places_(mesh_pieces_.size()),
        distances_(mesh_pieces_.size(), 0.0) {
    for (Eigen::Index t = 0; t < mesh_.triangles.rows(); ++t) {
      for (const int v : mesh_.triangles.row(t)) mesh_pieces_[at(v)] = mesh_.triangle_pieces[at(t)];
    }
  }

  void placeKnownSides(const std::vector<MaterialPoint>& known);
  void keepMostFrequentPiece();
  void seedUnplacedPieces();
  void spread(bool over_new_walls);
  const std::vector<MaterialPoint>& places() const { return places_; }

 private:
  using Link = std::pair<int, int>;  ///< from a vertex to a neighbour without a place
  static std::size_t at(Eigen::Index index) { return static_cast<std::size_t>(index); }
  MaterialPoint placeAfter(const MaterialPoint& place) const;
  std::uint32_t tetPieceOf(std::size_t v) const { return edit_.topology.tet_pieces[at(places_[v].tet)]; }
  std::vector<Link> linksToUnplaced(bool over_new_walls) const;

  const SurfaceCut& surface_;
  const MeshTopology& mesh_;
  const TetTopology& before_;
  const TetEdit& edit_;
  TetWalk walk_;
  std::vector<std::uint32_t> mesh_pieces_;  ///< per vertex of the mesh
  std::vector<MaterialPoint> places_;
  std::vector<double> distances_;  ///< along the mesh, from the vertices of known side
};

MaterialPoint SidePlacement::placeAfter(const MaterialPoint& place) const {
  const std::vector<int>& successors = edit_.successors[at(place.tet)];
  if (successors.size() == 1) return {successors.front(), place.barycentric};
  return edit_.placeAfter(place, before_);
}

void SidePlacement::placeKnownSides(const std::vector<MaterialPoint>& known) {
  const std::vector<bool> crack = crackVertices(before_, edit_);
  for (std::size_t v = 0; v < known.size(); ++v) {
    if (known[v].tet < 0) continue;
    const MaterialPoint place = placeAfter(known[v]);
    double off_crack = 0.0;
    for (int k = 0; k < 4; ++k) {
      if (!crack[at(edit_.topology.tets(place.tet, k))]) off_crack += place.barycentric[k];
    }
    if (off_crack >= 0.5) places_[v] = place;
  }
}

/// A piece of the mesh keeps its places in one piece of the tets only: the one with most places.
void SidePlacement::keepMostFrequentPiece() {
  const std::size_t piece_count = pieceCountOf(edit_.topology.tet_pieces);
  std::vector<int> counts(pieceCountOf(mesh_pieces_) * piece_count, 0);
  for (std::size_t v = 0; v < places_.size(); ++v) {
    if (places_[v].tet >= 0) ++counts[mesh_pieces_[v] * piece_count + tetPieceOf(v)];
  }
  std::vector<std::uint32_t> most;
  for (auto row = counts.begin(); row != counts.end(); row += static_cast<std::ptrdiff_t>(piece_count)) {
    const auto end = row + static_cast<std::ptrdiff_t>(piece_count);
    most.push_back(static_cast<std::uint32_t>(std::max_element(row, end) - row));
  }
  for (std::size_t v = 0; v < places_.size(); ++v) {
    if (places_[v].tet >= 0 && tetPieceOf(v) != most[mesh_pieces_[v]]) places_[v] = {};
  }
}

/// Places the first vertex of each piece of the mesh without places, starting at the centre of the piece.
void SidePlacement::seedUnplacedPieces() {
  struct Piece {
    int first = -1, count = 0;
    bool placed = false;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  };
  std::vector<Piece> pieces(pieceCountOf(mesh_pieces_));
  for (std::size_t v = 0; v < places_.size(); ++v) {
    Piece& piece = pieces[mesh_pieces_[v]];
    if (piece.first < 0) piece.first = static_cast<int>(v);
    piece.placed = piece.placed || places_[v].tet >= 0;
    piece.sum += mesh_.rest_vertices.row(static_cast<Eigen::Index>(v)).transpose();
    ++piece.count;
  }
  for (const Piece& piece : pieces) {
    if (piece.placed || piece.count == 0) continue;
    const MaterialPoint middle =
        TetLocator(edit_.topology.rest_vertices, edit_.topology.tets).locate(piece.sum / piece.count);
    places_[at(piece.first)] = walk_.towards(middle.tet, mesh_.rest_vertices.row(piece.first));
  }
}

/// Sorted by their start.
std::vector<SidePlacement::Link> SidePlacement::linksToUnplaced(bool over_new_walls) const {
  std::vector<Link> links;
  for (Eigen::Index t = 0; t < mesh_.triangles.rows(); ++t) {
    if (!over_new_walls && surface_.on_new_wall[at(t)]) continue;
    for (int k = 0; k < 3; ++k) {
      const int to = mesh_.triangles(t, k);
      if (places_[at(to)].tet >= 0) continue;
      links.emplace_back(mesh_.triangles(t, (k + 1) % 3), to);
      links.emplace_back(mesh_.triangles(t, (k + 2) % 3), to);
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

/// Shortest paths first (Dijkstra 1959), so that a place comes from its side of a slit, not around its end.
void SidePlacement::spread(bool over_new_walls) {
  const std::vector<Link> links = linksToUnplaced(over_new_walls);
  using Step = std::tuple<double, int, int>;  // distance, to, from
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  const auto follow = [&](const Link& link) {
    const auto [from, to] = link;
    if (places_[at(to)].tet >= 0) return;
    const double length = (mesh_.rest_vertices.row(from) - mesh_.rest_vertices.row(to)).norm();
    open.emplace(distances_[at(from)] + length, to, from);
  };
  for (const Link& link : links) {
    if (places_[at(link.first)].tet >= 0) follow(link);
  }
  while (!open.empty()) {
    const auto [distance, to, from] = open.top();
    open.pop();
    if (places_[at(to)].tet >= 0) continue;
    places_[at(to)] = walk_.towards(places_[at(from)].tet, mesh_.rest_vertices.row(to));
    distances_[at(to)] = distance;
    auto link = std::lower_bound(links.begin(), links.end(), Link{to, 0});
    for (; link != links.end() && link->first == to; ++link) follow(*link);
  }
}

}  // namespace

std::vector<MaterialPoint> placesByCutSide(const SurfaceCut& surface, const std::vector<MaterialPoint>& known,
                                           const TetTopology& before, const TetEdit& edit) {
  SidePlacement sides(surface, before, edit);
  sides.placeKnownSides(known);
  sides.keepMostFrequentPiece();
  sides.seedUnplacedPieces();
  sides.spread(false);
  sides.spread(true);
  return sides.places();
}

}  // namespace softbody
