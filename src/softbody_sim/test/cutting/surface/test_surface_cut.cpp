#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "cutting/fixtures/random_patches.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/split/curve_snapping.h"
#include "cutting/surface/surface_cut.h"
#include "fixtures/model_files.h"

namespace softbody {
namespace {

using namespace softbody::testing;

const std::string kShipped = SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/";

CutPatch rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  CutPatch patch;
  patch.vertices.resize(4, 3);
  patch.vertices << corner.transpose(), (corner + x).transpose(), (corner + x + y).transpose(),
      (corner + y).transpose();
  patch.triangles.resize(2, 3);
  patch.triangles << 0, 1, 2, 0, 2, 3;
  return patch;
}

double cutArea(const MeshTopology& mesh) {
  double area = 0.0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (!mesh.cut[static_cast<std::size_t>(t)]) continue;
    const Eigen::Vector3d a = mesh.rest_vertices.row(mesh.triangles(t, 0));
    const Eigen::Vector3d b = mesh.rest_vertices.row(mesh.triangles(t, 1));
    const Eigen::Vector3d c = mesh.rest_vertices.row(mesh.triangles(t, 2));
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

/// The lowest triangle of those that a cut has made, after rounding to single precision.
double lowestNewTriangle(const MeshTopology& mesh) {
  double lowest = 1.0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<Eigen::Vector3d, 3> corners;
    bool is_new = mesh.cut[static_cast<std::size_t>(t)];
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, k);
      corners[static_cast<std::size_t>(k)] = mesh.rest_vertices.row(v).cast<float>().cast<double>();
      is_new = is_new || mesh.vertex_parents[static_cast<std::size_t>(v)] < 0;
    }
    if (is_new) lowest = std::min(lowest, smallestHeight(corners[0], corners[1], corners[2]));
  }
  return lowest;
}

/// Few in make test, as many as SOFTBODY_CUTS_PER_BODY says in make cuts.
int numberOfCuts(int few) {
  const char* many = std::getenv("SOFTBODY_CUTS_PER_BODY");
  return many ? std::atoi(many) : few;
}

/// Cuts a mesh at random, each time up to three times one after the other.
void cutAtRandom(const MeshTopology& mesh, int count, unsigned seed) {
  const double volume = volumeOf(mesh);
  RandomPatches cuts(mesh.rest_vertices, mesh.triangles, seed);
  int refused = 0, made = 0;
  for (int k = 0; k < count; ++k) {
    MeshTopology before = mesh;
    for (int repeat = 0; repeat <= k % 3; ++repeat) {
      const int kind =
          repeat == 0 ? k % static_cast<int>(PatchKind::kCount) : static_cast<int>(cuts.uniform(0, 3));
      const SurfaceCut cut = cutSurface(before, cuts.next(static_cast<PatchKind>(kind)));
      SCOPED_TRACE(fmt::format("cut {}.{} of kind {}", k, repeat, kind));
      ++made;
      if (cut.outcome != CutOutcome::kCut) {
        EXPECT_FALSE(cut.reason.empty());
        EXPECT_EQ(cut.mesh.revision, before.revision);
        EXPECT_EQ(cut.mesh.rest_vertices, before.rest_vertices);
        if (cut.outcome == CutOutcome::kRefused) ++refused;
        continue;
      }
      ASSERT_EQ(faultOf(cut.mesh, volume), "");
      EXPECT_GE(lowestNewTriangle(cut.mesh), diagonalOf(mesh) / 400000.0);
      before = cut.mesh;
    }
  }
  fmt::print("{} cuts, {} refused\n", made, refused);
  // One in a hundred; of a sample, no more than three standard deviations above.
  const double share = 0.01 * made,
               deviation = std::getenv("SOFTBODY_CUTS_PER_BODY") ? 0.0 : std::sqrt(share);
  EXPECT_LE(refused, share + 3.0 * deviation);
}

TEST(SurfaceCut, SpongeInTwo) {
  const MeshTopology sponge = loadMesh(kShipped + "sponge.obj");
  const Eigen::Vector3d low = sponge.rest_vertices.colwise().minCoeff();
  const Eigen::Vector3d size = sponge.rest_vertices.colwise().maxCoeff().transpose() - low;
  const CutPatch patch =
      rectangle(low + Eigen::Vector3d(0.37 * size.x(), -0.1, -0.1), {0, 0.5, 0}, {0, 0, 0.5});
  const SurfaceCut cut = cutSurface(sponge, patch);
  ASSERT_EQ(cut.outcome, CutOutcome::kCut) << cut.reason;
  EXPECT_EQ(faultOf(cut.mesh, size.prod()), "");
  const auto volumes = pieceVolumes(cut.mesh);
  ASSERT_EQ(volumes.size(), 2u);
  EXPECT_NEAR(std::min(volumes.at(0), volumes.at(1)), 0.37 * size.prod(), 1e-6 * size.prod());
  EXPECT_NEAR(cutArea(cut.mesh), 2.0 * size.y() * size.z(), 1e-6);
}

TEST(SurfaceCut, PartialCutStaysOnePiece) {
  const MeshTopology sponge = loadMesh(kShipped + "sponge.obj");
  const Eigen::Vector3d low = sponge.rest_vertices.colwise().minCoeff();
  const Eigen::Vector3d size = sponge.rest_vertices.colwise().maxCoeff().transpose() - low;
  const Eigen::Vector3d corner = low + Eigen::Vector3d(0.37 * size.x(), -0.1, -0.1);
  const CutPatch patch = rectangle(corner, {0, 0.5, 0}, {0, 0, 0.1 + 0.6 * size.z()});
  const SurfaceCut cut = cutSurface(sponge, patch);
  ASSERT_EQ(cut.outcome, CutOutcome::kCut) << cut.reason;
  EXPECT_EQ(faultOf(cut.mesh, size.prod()), "");
  EXPECT_EQ(pieceVolumes(cut.mesh).size(), 1u);
  EXPECT_NEAR(cutArea(cut.mesh), 2.0 * size.y() * 0.6 * size.z(), 1e-6);
}

TEST(SurfaceCut, TorusWithAnnulus) {
  const MeshTopology mesh = torusSurface();
  const SurfaceCut cut = cutSurface(mesh, rectangle({-0.2, -0.2, 0.004}, {0.4, 0, 0}, {0, 0.4, 0}));
  ASSERT_EQ(cut.outcome, CutOutcome::kCut) << cut.reason;
  EXPECT_EQ(faultOf(cut.mesh, volumeOf(mesh)), "");
  EXPECT_EQ(pieceVolumes(cut.mesh).size(), 2u);
}

TEST(SurfaceCut, TorusOpenedAndParted) {
  const MeshTopology mesh = torusSurface();
  const SurfaceCut opened = cutSurface(mesh, rectangle({0, 0.001, -0.1}, {0.2, 0, 0}, {0, 0, 0.2}));
  EXPECT_EQ(pieceVolumes(opened.mesh).size(), 1u);
  const SurfaceCut parted = cutSurface(mesh, rectangle({-0.2, 0.001, -0.1}, {0.4, 0, 0}, {0, 0, 0.2}));
  EXPECT_EQ(pieceVolumes(parted.mesh).size(), 2u);
}

TEST(SurfaceCut, RandomCutsOfSponge) { cutAtRandom(loadMesh(kShipped + "sponge.obj"), numberOfCuts(90), 1); }

TEST(SurfaceCut, RandomCutsOfTorus) { cutAtRandom(torusSurface(), numberOfCuts(90), 2); }

TEST(SurfaceCut, RandomCutsOfSpot) { cutAtRandom(loadMesh(test::testData("spot.obj")), numberOfCuts(60), 3); }

TEST(SurfaceCut, DISABLED_RandomCutsOfToy) {
  cutAtRandom(loadMesh(test::sharedData("toys/toy_surface.obj")), numberOfCuts(60), 4);
}

TEST(SurfaceCut, NamesParentsAndInterpolatesTextureCoordinates) {
  MeshTopology sponge = loadMesh(kShipped + "sponge.obj");
  sponge.vertex_parents[0] = 1000;  // as where the file has coincident vertices
  sponge.texture_coordinates.setZero(3 * sponge.triangles.rows(), 3);
  const auto textureAt = [](const Eigen::RowVector3d& p) {
    return Eigen::RowVector3d(3.0 * p.x() - p.z(), 2.0 * p.y() + p.z(), 0.0);
  };
  for (Eigen::Index t = 0; t < sponge.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k)
      sponge.texture_coordinates.row(3 * t + k) = textureAt(sponge.rest_vertices.row(sponge.triangles(t, k)));
  }
  const SurfaceCut cut = cutSurface(sponge, rectangle({0.013, -0.2, -0.2}, {0.01, 0.4, 0}, {0, 0, 0.4}));
  ASSERT_EQ(cut.outcome, CutOutcome::kCut) << cut.reason;
  for (std::size_t v = 0; v < cut.vertex_sources.size(); ++v) {
    const int source = cut.vertex_sources[v], parent = cut.mesh.vertex_parents[v];
    EXPECT_EQ(parent, source < 0 ? -1 : sponge.vertex_parents[static_cast<std::size_t>(source)]);
    if (source < 0) continue;
    EXPECT_EQ(cut.mesh.rest_vertices.row(static_cast<Eigen::Index>(v)), sponge.rest_vertices.row(source));
  }
  for (Eigen::Index t = 0; t < cut.mesh.triangles.rows(); ++t) {
    const bool is_wall = cut.on_new_wall[static_cast<std::size_t>(t)];
    EXPECT_EQ(cut.mesh.cut[static_cast<std::size_t>(t)], is_wall);
    for (int k = 0; k < 3 && !is_wall; ++k) {
      const Eigen::RowVector3d expected = textureAt(cut.mesh.rest_vertices.row(cut.mesh.triangles(t, k)));
      EXPECT_LT((cut.mesh.texture_coordinates.row(3 * t + k) - expected).norm(), 1e-5);
    }
  }
}

/// Two cubes that touch along an edge: four triangles at it.
TEST(SurfaceCut, PartsCubesThatTouchInAnEdge) {
  TriangleMesh cubes;
  cubes.vertices.resize(16, 3);
  cubes.triangles.resize(24, 3);
  const int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (int cube = 0; cube < 2; ++cube) {
    for (int v = 0; v < 8; ++v)
      cubes.vertices.row(8 * cube + v) << 0.1 * (cube + v % 2), 0.1 * (cube + v / 2 % 2), 0.1 * (v / 4);
    for (int f = 0; f < 12; ++f) {
      for (int k = 0; k < 3; ++k) {
        const int v = 8 * cube + faces[f][k];
        cubes.triangles(12 * cube + f, k) = v == 8 ? 3 : v == 12 ? 7 : v;  // the shared edge's ends
      }
    }
  }
  SurfaceFile file;
  file.mesh = cubes;
  Warnings warnings;
  const MeshTopology mesh = meshTopology(repairSurface(file, "cubes", &warnings).mesh);
  const SurfaceCut cut = cutSurface(mesh, rectangle({-0.1, -0.1, 0.031}, {0.5, 0, 0}, {0, 0.5, 0}));
  ASSERT_EQ(cut.outcome, CutOutcome::kCut) << cut.reason;
  EXPECT_EQ(faultOf(cut.mesh, 0.002), "");
  EXPECT_EQ(pieceVolumes(cut.mesh).size(), 4u);
}

}  // namespace
}  // namespace softbody
