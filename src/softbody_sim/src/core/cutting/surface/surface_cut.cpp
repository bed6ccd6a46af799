#include "cutting/surface/surface_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "cutting/fill/cut_fill.h"
#include "cutting/fill/cut_fill_edits.h"
#include "cutting/remesh/cut_remeshing.h"
#include "cutting/split/curve_snapping.h"
#include "cutting/split/cut_curve.h"
#include "cutting/split/cut_refused.h"
#include "cutting/split/split_surface.h"
#include "cutting/surface/coplanar_faces.h"
#include "cutting/surface/surface_compaction.h"
#include "cutting/surface/surface_stitching.h"
#include "surface_mesh/manifold_mesh.h"

namespace softbody {
namespace {

// Relative to the diagonal of the body's bounding box.
constexpr double kSnapDistance = 1.0 / 20000.0;
constexpr double kLowestTriangle = 1.0 / 400000.0;  // above the rounding of Point32
constexpr double kFlatness = 1.0 / 100000.0;        // of a patch: below what snapping moves
constexpr double kRemeshDistance = 1.0 / 2000.0;    // 0.1 mm of a hand-sized body: not seen
constexpr double kCoplanarDistance = 3.0 * kSnapDistance;
constexpr double kOfLowTriangle = 0.01;  // of the height of its source
constexpr int kAttempts = 6;             // a bound; each moves the patch farther

/// "(-0.1, 0, 0.02)".
std::string cornerText(const Eigen::RowVector3d& corner) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", corner.x(), corner.y(), corner.z());
}

double diagonalOf(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

void roundNewVertices(SplitSurface* surface) {
  for (std::size_t v = static_cast<std::size_t>(surface->own_vertices); v < surface->vertices.size(); ++v) {
    surface->vertices[v] = rounded(surface->vertices[v]);
  }
}

SurfaceCut withoutCut(const MeshTopology& mesh, CutOutcome outcome, const std::string& reason) {
  SurfaceCut result{outcome, reason, mesh, {}, {}, {}};
  result.vertex_sources.resize(static_cast<std::size_t>(mesh.rest_vertices.rows()));
  std::iota(result.vertex_sources.begin(), result.vertex_sources.end(), 0);
  result.on_new_wall.resize(static_cast<std::size_t>(mesh.triangles.rows()));
  return result;
}

/// @throw CutRefused if a new triangle is too low after rounding. Parts of a low triangle of the mesh may be
/// lower.
void checkHeights(const MeshTopology& mesh, const SplitSurface& surface, const StitchedSurface& stitched,
                  double lowest) {
  const std::vector<Eigen::Vector3d>& vertices = stitched.vertices;
  const auto check = [&](std::size_t t, double limit) {
    const auto& [a, b, c] = stitched.triangles[t];
    const double height = smallestHeight(rounded(vertices[a]), rounded(vertices[b]), rounded(vertices[c]));
    if (height < limit) throw CutRefused(fmt::format("it would leave a triangle {:.2g} m high", height));
  };
  for (const int t : surface.changed) {
    if (!surface.used(t)) continue;
    const auto source = mesh.triangles.row(surface.sources[t]);
    const double source_height =
        smallestHeight(mesh.rest_vertices.row(source[0]), mesh.rest_vertices.row(source[1]),
                       mesh.rest_vertices.row(source[2]));
    check(static_cast<std::size_t>(t), std::min(lowest, kOfLowTriangle * source_height));
  }
  for (std::size_t t = surface.triangles.size(); t < stitched.triangles.size(); ++t) check(t, lowest);
}

/// @throw CutRefused if a piece is thinner than the snapping distance: volume / (area / 2).
void checkPieces(const MeshTopology& mesh, double snap_distance) {
  std::vector<double> excess(
      mesh.triangle_pieces.empty()
          ? 0
          : *std::max_element(mesh.triangle_pieces.begin(), mesh.triangle_pieces.end()) + 1);
  const Eigen::Vector3d origin = mesh.rest_vertices.row(0);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return mesh.rest_vertices.row(mesh.triangles(t, k)).transpose() - origin;
    };
    const Eigen::Vector3d a = corner(0), area = 0.5 * (corner(1) - a).cross(corner(2) - a);
    excess[mesh.triangle_pieces[static_cast<std::size_t>(t)]] +=
        area.dot(a) / 3.0 - 0.5 * area.norm() * snap_distance;
  }
  if (std::any_of(excess.begin(), excess.end(), [](double volume) { return volume <= 0.0; })) {
    throw CutRefused("it would leave a piece without thickness");
  }
}

/// The patch coincides with the surface: it must be moved outward.
struct CutIsCoplanar : CutRefused {
  explicit CutIsCoplanar(const Eigen::Vector3d& normal)
      : CutRefused("the patch runs along the surface"), outward(normal) {}
  Eigen::Vector3d outward;
};

class SurfaceCutter {
 public:
  /// Keeps references to both.
  SurfaceCutter(const MeshTopology& mesh, const ManifoldMesh& manifold)
      : mesh_(mesh),
        triangles_(manifold.triangles),
        mates_(manifold.mates),
        diagonal_(diagonalOf(mesh.rest_vertices)) {}

  SurfaceCut cut(const CutPatch& patch) const;

 private:
  SurfaceCut attempt(const CutPatch& patch) const;

  const MeshTopology& mesh_;
  const TriangleList& triangles_;
  const std::vector<int>& mates_;
  double diagonal_;
};

SurfaceCut SurfaceCutter::attempt(const CutPatch& patch) const {
  const double snap_distance = kSnapDistance * diagonal_;
  const PatchFacets facets = facetsOf(patch, kFlatness * diagonal_);
  const CutCurve curve = intersect(mesh_.rest_vertices, triangles_, mates_, facets);
  SplitSurface surface = splitAlong(curve, mesh_, triangles_, mates_);
  snapCurve(snap_distance, &surface);
  splitLoneSegments(&surface);
  roundNewVertices(&surface);
  if (halfEdgesOfCurve(surface).empty()) {
    return withoutCut(
        mesh_, CutOutcome::kMissed,
        fmt::format("the patch does not pass through the surface: the body extends from {} to {} "
                    "m in the rest frame, the patch from {} to {} m",
                    cornerText(mesh_.rest_vertices.colwise().minCoeff()),
                    cornerText(mesh_.rest_vertices.colwise().maxCoeff()),
                    cornerText(patch.vertices.colwise().minCoeff()),
                    cornerText(patch.vertices.colwise().maxCoeff())));
  }
  CutFill fill = fillWalls(surface, curve, facets, snap_distance);
  raiseLowTriangles(0.5 * snap_distance, facets, &fill);
  const CoplanarFaces coplanar = findCoplanarFaces(surface, fill, facets, kCoplanarDistance * diagonal_);
  if (coplanar.count == fill.triangles.size()) {
    return withoutCut(mesh_, CutOutcome::kMissed, "the patch only grazes the surface");
  }
  if (coplanar.count > 0) throw CutIsCoplanar(coplanar.outward);
  remeshCut(mesh_.cut, kRemeshDistance * diagonal_, &surface, &fill);
  const StitchedSurface stitched = stitch(surface, std::move(fill));
  checkHeights(mesh_, surface, stitched, kLowestTriangle * diagonal_);
  SurfaceCut result = compacted(mesh_, surface, stitched);
  checkPieces(result.mesh, snap_distance);
  return result;
}

/// A degenerate position of mesh and patch makes an attempt fail. The next attempt moves the patch by little
/// more than the snapping distance.
SurfaceCut SurfaceCutter::cut(const CutPatch& patch) const {
  std::string reason;
  CutPatch moved = inGeneralPosition(patch);
  for (int k = 1; k <= kAttempts; ++k) {
    Eigen::Vector3d shift = (k % 2 == 0 ? k : -k) * Eigen::Vector3d(0.61, -0.43, 0.67);
    try {
      return attempt(moved);
    } catch (const CutIsCoplanar& refusal) {
      if (k == 1) reason = refusal.what(), shift = refusal.outward;
    } catch (const CutRefused& refusal) {
      if (k == 1) reason = refusal.what();
    }
    moved.vertices = patch.vertices.rowwise() + 2.0 * kSnapDistance * diagonal_ * shift.transpose();
  }
  return withoutCut(mesh_, CutOutcome::kRefused, reason);
}

/// The mesh with duplicated non-manifold vertices.
MeshTopology withCopies(MeshTopology mesh, const ManifoldMesh& manifold) {
  const auto own = mesh.rest_vertices.rows(), copies = static_cast<Eigen::Index>(manifold.copied_from.size());
  mesh.rest_vertices.conservativeResize(own + copies, Eigen::NoChange);
  for (Eigen::Index v = own; v < own + copies; ++v) {
    const int source = manifold.copied_from[static_cast<std::size_t>(v - own)];
    mesh.rest_vertices.row(v) = mesh.rest_vertices.row(source).eval();
    mesh.vertex_parents.push_back(mesh.vertex_parents[static_cast<std::size_t>(source)]);
  }
  for (std::size_t t = 0; t < manifold.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) mesh.triangles(static_cast<Eigen::Index>(t), k) = manifold.triangles[t][k];
  }
  return mesh;
}

}  // namespace

SurfaceCut cutSurface(const MeshTopology& mesh, const CutPatch& patch) {
  return cutSurface(mesh, splitNonManifold(listOf(mesh.triangles), mesh.rest_vertices), patch);
}

SurfaceCut cutSurface(const MeshTopology& mesh, const ManifoldMesh& manifold, const CutPatch& patch) {
  if (manifold.copied_from.empty()) return SurfaceCutter(mesh, manifold).cut(patch);
  const MeshTopology separated = withCopies(mesh, manifold);
  SurfaceCut cut = SurfaceCutter(separated, manifold).cut(patch);
  if (cut.outcome != CutOutcome::kCut) return withoutCut(mesh, cut.outcome, cut.reason);
  const auto own = static_cast<int>(mesh.rest_vertices.rows());
  for (int& source : cut.vertex_sources) {
    if (source >= own) source = manifold.copied_from[static_cast<std::size_t>(source - own)];
  }
  return cut;
}

}  // namespace softbody
