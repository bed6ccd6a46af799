#include "softbody_common/geometry/surface_binding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "random_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

constexpr double kMiddle = 2.0;

/// Copies, for the tets of the far half, the vertices of the middle plane nearer than `depth`.
TetTopology slit(const TetMesh& mesh, double depth) {
  TetTopology volume;
  volume.rest_vertices = mesh.vertices;
  volume.tets = mesh.tets;
  std::map<int, int> copies;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) {
    double x = 0.0;
    for (int k = 0; k < 4; ++k) x += 0.25 * mesh.vertices(mesh.tets(t, k), 0);
    if (x < kMiddle) continue;
    for (int k = 0; k < 4; ++k) {
      const int v = mesh.tets(t, k);
      if (mesh.vertices(v, 0) != kMiddle || mesh.vertices(v, 1) >= depth) continue;
      const int next = static_cast<int>(mesh.vertices.rows() + copies.size());
      volume.tets(t, k) = copies.emplace(v, next).first->second;
    }
  }
  volume.rest_vertices.conservativeResize(mesh.vertices.rows() + static_cast<Eigen::Index>(copies.size()), 3);
  for (const auto& [from, to] : copies) volume.rest_vertices.row(to) = mesh.vertices.row(from);
  volume.surface = boundaryTriangles(volume.tets);
  return volume;
}

/// The tets' own boundary as the visual mesh: where a vertex must be is then known.
MeshTopology boundaryOf(const TetTopology& volume) {
  MeshTopology surface;
  surface.rest_vertices = volume.rest_vertices;
  surface.triangles = volume.surface;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    bool in_middle = true;
    for (int k = 0; k < 3; ++k)
      in_middle = in_middle && surface.rest_vertices(surface.triangles(f, k), 0) == kMiddle;
    surface.cut.push_back(in_middle);
  }
  return surface;
}

/// The far half moved away: copies and originals of the middle plane are no longer at the same place.
Points opened(const TetTopology& volume, int originals) {
  Points moved = volume.rest_vertices;
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    if (v >= originals || volume.rest_vertices(v, 0) > kMiddle) moved(v, 0) += 1.0;
  }
  return moved;
}

class SurfaceBinding : public ::testing::TestWithParam<double> {};

TEST_P(SurfaceBinding, WallsFollowTheTetsBehindThem) {
  const TetMesh mesh = blockOfTets(4, 4, 4, 1.0);
  const TetTopology volume = slit(mesh, GetParam());
  const MeshTopology surface = boundaryOf(volume);
  const std::vector<MaterialPoint> places = bindSurface(surface, volume);
  const Points moved = opened(volume, static_cast<int>(mesh.vertices.rows()));
  EXPECT_LT((applyBinding(places, volume.rest_vertices, volume.tets) - surface.rest_vertices).norm(), 1e-12);
  const Points followed = applyBinding(places, moved, volume.tets);
  for (int v : surface.triangles.reshaped()) {
    const bool front = volume.rest_vertices(v, 0) == kMiddle && volume.rest_vertices(v, 1) >= GetParam();
    if (front) continue;
    EXPECT_LT((followed.row(v) - moved.row(v)).norm(), 1e-9) << volume.rest_vertices.row(v);
  }
}

/// Walls of tets and of the visual mesh need not agree exactly.
TEST_P(SurfaceBinding, WallsThatLieALittleOff) {
  const TetMesh mesh = blockOfTets(4, 4, 4, 1.0);
  const TetTopology volume = slit(mesh, GetParam());
  MeshTopology surface = boundaryOf(volume);
  for (Eigen::Index v = 0; v < surface.rest_vertices.rows(); ++v) {
    if (surface.rest_vertices(v, 0) == kMiddle) surface.rest_vertices(v, 0) += 0.05;
  }
  const Points moved = opened(volume, static_cast<int>(mesh.vertices.rows()));
  const Points followed = applyBinding(bindSurface(surface, volume), moved, volume.tets);
  for (int v : surface.triangles.reshaped()) {
    const bool front =
        volume.rest_vertices(v, 0) == kMiddle && volume.rest_vertices(v, 1) >= GetParam() - 1.0;
    if (front) continue;
    EXPECT_LT((followed.row(v) - moved.row(v)).norm(), 0.06) << volume.rest_vertices.row(v);
  }
}

TEST_P(SurfaceBinding, PlacesStayOnTheirSide) {
  std::mt19937 random(3);
  const TetMesh mesh = blockOfTets(4, 4, 4, 1.0);
  const TetTopology cut = slit(mesh, GetParam());
  TetTopology whole;
  whole.rest_vertices = mesh.vertices;
  whole.tets = mesh.tets;
  std::vector<MaterialPoint> places;
  for (int i = 0; i < 300; ++i) {
    Eigen::Vector4d weights = Eigen::Vector4d::Random().cwiseAbs();
    if (i % 3 == 0) weights[i % 4] = 0.0;  // on a face, perhaps one in the middle plane
    places.push_back({static_cast<int>(random() % mesh.tets.rows()), weights / weights.sum()});
  }
  const std::vector<MaterialPoint> after = transferPlaces(places, whole, cut);
  ASSERT_EQ(after.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    // Slitting keeps tets and their numbers.
    EXPECT_EQ(after[i].tet, places[i].tet);
    EXPECT_EQ(after[i].barycentric, places[i].barycentric);
  }
}

INSTANTIATE_TEST_SUITE_P(Slits, SurfaceBinding, ::testing::Values(2.0, 3.0, 5.0));

}  // namespace
}  // namespace softbody
