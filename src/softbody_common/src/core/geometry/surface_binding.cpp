#include "softbody_common/geometry/surface_binding.h"

#include <algorithm>
#include <map>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

// Shares of the mean tet edge, and of the way. kInwards is more than the distance between the walls of the
// tets and the walls of the surface.
constexpr double kInwards = 0.1;
constexpr double kTowardsCentroid = 1e-3;

using Bodies = std::vector<std::uint32_t>;

/// The tets of one piece.
class Piece {
 public:
  Piece(const TetTopology& volume, const Bodies& bodies, std::uint32_t body)
      : members_(membersOf(bodies, body)),
        locator_(volume.rest_vertices, volume.tets(members_, Eigen::all)) {}

  int tetAt(const Eigen::Vector3d& point) const { return members_[locator_.locate(point).tet]; }

 private:
  static std::vector<int> membersOf(const Bodies& bodies, std::uint32_t body) {
    std::vector<int> members;
    for (std::size_t t = 0; t < bodies.size(); ++t) {
      if (bodies[t] == body) members.push_back(static_cast<int>(t));
    }
    return members;
  }

  std::vector<int> members_;
  TetLocator locator_;
};

/// The vertices; those of cut faces are moved by `depth` into the body.
Points insidePoints(const MeshTopology& surface, double depth) {
  std::vector<Eigen::Index> walls;
  for (std::size_t f = 0; f < surface.cut.size(); ++f) {
    if (surface.cut[f]) walls.push_back(static_cast<Eigen::Index>(f));
  }
  const Triangles triangles = surface.triangles(walls, Eigen::all);
  return surface.rest_vertices - depth * vertexNormals(surface.rest_vertices, triangles);
}

/// For every piece of the surface: the piece of the tets that contains most of its vertices.
std::map<std::uint32_t, std::uint32_t> matchPieces(const Bodies& surface_bodies, const Bodies& tet_bodies,
                                                   const std::vector<int>& tets) {
  std::map<std::uint32_t, std::map<std::uint32_t, int>> votes;
  for (std::size_t v = 0; v < tets.size(); ++v) ++votes[surface_bodies[v]][tet_bodies[tets[v]]];
  std::map<std::uint32_t, std::uint32_t> matches;
  for (const auto& [surface_body, counts] : votes) {
    matches[surface_body] = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                              return a.second < b.second;
                            })->first;
  }
  return matches;
}

/// Moves vertices that were located in tets of another piece to tets of their own piece.
void keepToPieces(const MeshTopology& surface, const TetTopology& volume, const Points& inside,
                  std::vector<int>* tets) {
  const Bodies tet_bodies = tetPieces(volume.tets, static_cast<int>(volume.rest_vertices.rows()));
  if (std::count(tet_bodies.begin(), tet_bodies.end(), 0u) == volume.tets.rows()) return;
  const Bodies surface_bodies = vertexPieces(
      surface.triangles, trianglePieces(surface.triangles, static_cast<int>(inside.rows())), inside.rows());
  const auto own_piece = matchPieces(surface_bodies, tet_bodies, *tets);
  std::map<std::uint32_t, Piece> pieces;
  for (std::size_t v = 0; v < tets->size(); ++v) {
    const std::uint32_t own = own_piece.at(surface_bodies[v]);
    if (tet_bodies[(*tets)[v]] == own) continue;
    const Piece& piece = pieces.try_emplace(own, volume, tet_bodies, own).first->second;
    (*tets)[v] = piece.tetAt(inside.row(static_cast<Eigen::Index>(v)));
  }
}

/// Whether both topologies have the same tet at this index, with the same corners at rest.
bool isSameTet(int tet, const TetTopology& a, const TetTopology& b) {
  return tet < b.tets.rows() &&
         a.rest_vertices(a.tets.row(tet), Eigen::all) == b.rest_vertices(b.tets.row(tet), Eigen::all);
}

}  // namespace

std::vector<MaterialPoint> bindSurface(const MeshTopology& surface, const TetTopology& volume) {
  const Points inside = insidePoints(surface, kInwards * meanEdgeLength(volume.rest_vertices, volume.tets));
  const TetLocator locator(volume.rest_vertices, volume.tets);
  std::vector<int> tets;
  for (const auto& point : inside.rowwise()) tets.push_back(locator.locate(point).tet);
  keepToPieces(surface, volume, inside, &tets);
  std::vector<MaterialPoint> places;
  places.reserve(tets.size());
  for (std::size_t v = 0; v < tets.size(); ++v) {
    places.push_back({tets[v], barycentricCoordinates(surface.rest_vertices.row(static_cast<Eigen::Index>(v)),
                                                      volume.rest_vertices, volume.tets.row(tets[v]))});
  }
  return places;
}

std::vector<MaterialPoint> transferPlaces(const std::vector<MaterialPoint>& places, const TetTopology& before,
                                          const TetTopology& after) {
  const TetLocator locator(after.rest_vertices, after.tets);
  std::vector<MaterialPoint> result;
  for (const MaterialPoint& place : places) {
    if (place.barycentric.minCoeff() >= 0.0 && isSameTet(place.tet, before, after)) {
      result.push_back(place);
      continue;
    }
    const Eigen::Vector3d point = positionOf(place, before.rest_vertices, before.tets);
    const Eigen::Vector3d centroid =
        positionOf({place.tet, Eigen::Vector4d::Constant(0.25)}, before.rest_vertices, before.tets);
    const int tet = locator.locate(point + kTowardsCentroid * (centroid - point)).tet;
    result.push_back({tet, barycentricCoordinates(point, after.rest_vertices, after.tets.row(tet))});
  }
  return result;
}

}  // namespace softbody
