#include "cage/volume_maker.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>

#include "cage/alpha_wrap.h"
#include "cage/cage_fitting.h"
#include "cage/enclosure.h"
#include "cage/progressive_hull.h"
#include "cage/tet_mesher.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "surface_mesh/self_intersection.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

constexpr int kFewestVertices = 100;                     ///< a box of eight corners could not bend
constexpr int kFewestByShape = 180, kMostByShape = 400;  ///< bends; a step takes a few ms
constexpr int kFittingRounds = 3;                        ///< a bound; the last one takes all that is outside
constexpr double kEdgePerThickness = 0.8;  ///< as the sponge of Kang et al. 2022: 20 mm edges, 25 mm thick

struct Wrapping {
  double alpha;   ///< gaps narrower than this are closed [edge lengths]
  double offset;  ///< from the mesh to its wrap [edge lengths]
};
/// In the order of attempts: a tight cage first, then finer wraps and larger offsets.
constexpr Wrapping kWrappings[] = {{0.5, 0.03}, {0.33, 0.03}, {0.33, 0.1}, {0.5, 0.3}};

/// Edge length of nearly regular triangles, two per vertex, that cover the area.
double edgeLengthFor(double area, int vertices) {
  return std::sqrt(area / (std::sqrt(3.0) / 2.0 * vertices));
}

/// The number of vertices for edges slightly shorter than the body's mean thickness 2 V / A.
int verticesByShape(const TriangleMesh& visual) {
  const double area = areaOf(visual);
  const double coarse = edgeLengthFor(area, kFewestByShape);
  const TriangleMesh wrap = alphaWrap(visual, coarse, 0.03 * coarse);
  const double edge = kEdgePerThickness * 2.0 * enclosedVolume(wrap.vertices, wrap.triangles) / areaOf(wrap);
  const double vertices = areaOf(wrap) / (std::sqrt(3.0) / 2.0 * edge * edge);
  return static_cast<int>(std::clamp<double>(vertices, kFewestByShape, kMostByShape));
}

Points stacked(const Points& a, const Points& b) {
  Points both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

/// Fits the cage around the vertices of the wrap first, which are fewer than the visual ones. Visual vertices
/// that are still outside are added, in the last round all of them.
TriangleMesh fitAround(const TriangleMesh& hull, const TriangleMesh& wrap, const Points& visual) {
  Points enclosed = wrap.vertices;
  for (int round = 0; round < kFittingRounds; ++round) {
    TriangleMesh cage = fitCage(hull, enclosed);
    const std::vector<Eigen::Index> beyond = pointsBeyond(visual, cage);
    if (beyond.empty()) return cage;
    enclosed = stacked(enclosed, visual(beyond, Eigen::all));
  }
  return fitCage(hull, stacked(wrap.vertices, visual));
}

TetMesh wrapAndFill(const TriangleMesh& visual, int cage_vertices, const Wrapping& wrapping,
                    const std::function<void(double)>& progress) {
  const double edge_length = edgeLengthFor(areaOf(visual), cage_vertices);
  const TriangleMesh wrap = alphaWrap(visual, wrapping.alpha * edge_length, wrapping.offset * edge_length);
  progress(0.3);
  const TriangleMesh hull = progressiveHull(wrap, cage_vertices);
  if (intersectsItself(hull)) throw std::runtime_error("the cage intersects itself");
  progress(0.5);
  const TriangleMesh cage = fitAround(hull, wrap, visual.vertices);
  progress(0.8);
  TetMesh mesh = meshInside(cage, edge_length, true);
  const Triangles boundary = boundaryTriangles(mesh.tets);
  if (boundary.rows() != cage.triangles.rows()) throw std::runtime_error("the tets do not fill the cage");
  const auto outside = pointsOutside(visual.vertices, mesh, boundary);
  if (!outside.empty()) {
    throw std::runtime_error(
        fmt::format("{} of {} vertices are outside of the cage", outside.size(), visual.vertices.rows()));
  }
  progress(1.0);
  return mesh;
}

}  // namespace

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.triangles(f, 0)),
                          b = mesh.vertices.row(mesh.triangles(f, 1)),
                          c = mesh.vertices.row(mesh.triangles(f, 2));
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

TetMesh volumeAround(const TriangleMesh& visual, int cage_vertices,
                     const std::function<void(double)>& progress) {
  if (cage_vertices == 0) cage_vertices = verticesByShape(visual);
  progress(0.1);
  std::string reason;
  for (const Wrapping& wrapping : kWrappings) {
    try {
      return wrapAndFill(visual, cage_vertices, wrapping, progress);
    } catch (const std::system_error&) {
      throw;  // another wrap would not help
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
  }
  throw std::runtime_error(reason);
}

TetMesh volumeInside(const TriangleMesh& cage) {
  if (intersectsItself(cage)) throw std::runtime_error("the cage intersects itself");
  const bool is_fine = cage.vertices.rows() >= kFewestVertices;
  const int vertices = std::max(kFewestVertices, static_cast<int>(cage.vertices.rows()));
  return meshInside(cage, edgeLengthFor(areaOf(cage), vertices), is_fine);
}

}  // namespace softbody
