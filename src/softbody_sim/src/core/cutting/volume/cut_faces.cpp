#include "cutting/volume/cut_faces.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "cutting/volume/manifold.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A face of a tet and the opposite corner.
struct FaceUse {
  Face face;
  int tet, corner;
  bool operator<(const FaceUse& other) const { return std::tie(face, tet) < std::tie(other.face, other.tet); }
};

/// The faces of all tets for which `wanted` is true; faces with the same vertices are adjacent.
template <class Wanted>
std::vector<FaceUse> faceUses(const Tets& tets, const Wanted& wanted) {
  std::vector<FaceUse> uses;
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    for (int k = 0; k < 4; ++k) {
      if (wanted(t, k)) uses.push_back({faceOf(tets, t, k), t, k});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

/// A point on the tet's side of the cut: the corner opposite to the face, or the centre if that is on the
/// cut.
Eigen::Vector3d sideOf(const FaceUse& use, const Points& vertices, const Tets& tets,
                       const std::vector<bool>& on_cut) {
  const int opposite = tets(use.tet, use.corner);
  if (!on_cut[static_cast<std::size_t>(opposite)]) return vertices.row(opposite);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const int vertex : tets.row(use.tet)) center += 0.25 * vertices.row(vertex).transpose();
  return center;
}

bool touchesAny(const Face& face, const std::vector<int>& vertices) {
  return std::any_of(face.begin(), face.end(),
                     [&vertices](int v) { return std::binary_search(vertices.begin(), vertices.end(), v); });
}

/// The new non-manifold vertices after opening; of copies, their originals; ascending.
std::vector<int> newlyNonManifold(const Triangles& surface, const std::vector<int>& before, int vertex_count,
                                  const std::vector<int>& copied_from) {
  std::vector<int> found = nonManifoldVertices(surface);
  for (int& v : found) {
    if (v >= vertex_count) v = copied_from[static_cast<std::size_t>(v - vertex_count)];
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<int> made;
  std::set_difference(found.begin(), found.end(), before.begin(), before.end(), std::back_inserter(made));
  return made;
}

/// The faces of `all` that two tets still share after opening, by their new vertices.
std::vector<Face> stillShared(const std::vector<Face>& all, const Tets& before, const Tets& after) {
  std::vector<Face> shared;
  const auto uses = faceUses(
      before, [&](int t, int k) { return std::binary_search(all.begin(), all.end(), faceOf(before, t, k)); });
  for (std::size_t u = 0; u + 1 < uses.size(); ++u) {
    if (uses[u].face != uses[u + 1].face) continue;
    const Face one = faceOf(after, uses[u].tet, uses[u].corner);
    if (one == faceOf(after, uses[u + 1].tet, uses[u + 1].corner)) shared.push_back(one);
  }
  std::sort(shared.begin(), shared.end());
  return shared;
}

}  // namespace

std::vector<Face> facesAlong(const PatchIntersector& patch, const Points& vertices, const Tets& tets,
                             const std::vector<bool>& on_cut) {
  const auto on = [&](int t, int k) { return on_cut[static_cast<std::size_t>(tets(t, k % 4))]; };
  const auto uses =
      faceUses(tets, [&on](int t, int k) { return on(t, k + 1) && on(t, k + 2) && on(t, k + 3); });
  std::vector<Face> faces;
  for (std::size_t u = 0; u + 1 < uses.size(); ++u) {
    if (uses[u].face != uses[u + 1].face) continue;
    if (patch.separates(sideOf(uses[u], vertices, tets, on_cut), sideOf(uses[u + 1], vertices, tets, on_cut)))
      faces.push_back(uses[u].face);
  }
  return faces;
}

ManifoldCrack openManifoldCrack(const Tets& tets, int vertex_count, std::vector<Face> cut_faces,
                                const std::vector<int>& known) {
  const std::vector<Face> all = cut_faces;
  ManifoldCrack crack;
  for (;;) {
    crack.opened = openCrack(tets, vertex_count, cut_faces);
    crack.surface = boundaryTriangles(crack.opened.tets);
    const std::vector<int> made =
        newlyNonManifold(crack.surface, known, vertex_count, crack.opened.copied_from);
    const auto kept = std::remove_if(cut_faces.begin(), cut_faces.end(),
                                     [&made](const Face& face) { return touchesAny(face, made); });
    if (kept == cut_faces.end()) break;
    cut_faces.erase(kept, cut_faces.end());
    crack.pinches.insert(crack.pinches.end(), made.begin(), made.end());
  }
  crack.closed_faces = stillShared(all, tets, crack.opened.tets);
  return crack;
}

}  // namespace softbody
