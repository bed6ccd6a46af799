#include "volume_maker.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "alpha_wrap.h"
#include "enclosure.h"
#include "softbody_common/tet_geometry.h"
#include "surface_repair.h"
#include "tet_mesher.h"

namespace softbody {
namespace {

constexpr double kAlpha = 0.5;  ///< gaps narrower than this are closed [edge lengths]
constexpr double kCountTolerance = 0.15;
constexpr int kSizings = 6;
constexpr int kFewestVertices = 100;  ///< a given box of eight corners could not bend

/// Edge length at which near regular triangles, two per vertex, cover the area.
double edgeLengthFor(double area, int vertices) {
  return std::sqrt(area / (std::sqrt(3.0) / 2.0 * vertices));
}

int boundaryVertexCount(const TetMesh& mesh) {
  const Triangles boundary = boundaryTriangles(mesh.tets);
  const auto corners = boundary.reshaped();
  return static_cast<int>(std::set<int>(corners.begin(), corners.end()).size());
}

bool hasManifoldBoundary(const TetMesh& mesh) { return examineEdges(boundaryTriangles(mesh.tets)).closed(); }

/// Tets around the mesh with about the wanted number of boundary vertices: refinement only bounds sizes from
/// above, so the size is found by trying.
TetMesh sizedVolume(const TriangleMesh& visual, int cage_vertices, double offset) {
  double edge_length = edgeLengthFor(areaOf(visual), cage_vertices);
  TetMesh best;
  double best_error = 0.0;
  for (int sizing = 0; sizing < kSizings; ++sizing) {
    const TriangleMesh wrap = alphaWrap(visual, kAlpha * edge_length, offset * edge_length);
    TetMesh mesh = meshInside(wrap, edge_length);
    const double ratio = static_cast<double>(boundaryVertexCount(mesh)) / cage_vertices;
    const double error = std::abs(std::log(ratio));
    if (best.tets.rows() == 0 || error < best_error) {
      best = std::move(mesh);
      best_error = error;
    }
    if (best_error < kCountTolerance) break;
    edge_length *= std::sqrt(ratio);
  }
  return best;
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

TetMesh volumeAround(const TriangleMesh& visual, int cage_vertices) {
  TetMesh mesh;
  // A tight cage first; a wider one where that is too thin for its edges, or cannot be pushed around all
  // vertices.
  for (const double offset : {0.15, 0.3, 0.5}) {
    mesh = sizedVolume(visual, cage_vertices, offset);
    if (hasManifoldBoundary(mesh) && growToEnclose(visual.vertices, &mesh)) break;
  }
  return mesh;
}

TetMesh volumeInside(const TriangleMesh& cage, const Points& enclosed) {
  const int vertices = std::max(kFewestVertices, static_cast<int>(cage.vertices.rows()));
  const double edge_length = edgeLengthFor(areaOf(cage), vertices);
  TetMesh mesh;
  // As coarse as the cage first; finer where that is too coarse for its thin parts.
  for (const double share : {1.0, 0.7, 0.5}) {
    mesh = meshInside(cage, share * edge_length);
    if (hasManifoldBoundary(mesh) && growToEnclose(enclosed, &mesh)) break;
  }
  return mesh;
}

}  // namespace softbody
