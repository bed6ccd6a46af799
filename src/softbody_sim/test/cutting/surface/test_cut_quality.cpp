#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cutting/fixtures/cut_shapes_of.h"
#include "cutting/fixtures/random_patches.h"
#include "cutting/fixtures/same_topology.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/surface/surface_cut.h"
#include "fixtures/box_meshes.h"
#include "fixtures/model_files.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody {
namespace {

using namespace softbody::testing;

MeshTopology shippedSponge() {
  return loadMesh(SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/sponge.obj");
}

/// Calls visit(patch, cut mesh) for a number of random cuts through the whole mesh. Few planes may miss it.
template <class Visit>
void forEachPlaneCut(const MeshTopology& mesh, int count, unsigned seed, const Visit& visit) {
  RandomPatches patches(mesh.rest_vertices, mesh.triangles, seed);
  int made = 0;
  for (int k = 0; k < 2 * count && made < count; ++k) {
    const CutPatch patch = patches.next(PatchKind::kPlane);
    const SurfaceCut cut = cutSurface(mesh, patch);
    if (cut.outcome != CutOutcome::kCut) continue;
    SCOPED_TRACE(fmt::format("plane {}", k));
    visit(patch, cut.mesh);
    ++made;
  }
  EXPECT_EQ(made, count);
}

/// Largest distance of a corner of the skin to another surface [m].
double farthestOfSkin(const MeshTopology& mesh, const ClosestPointQuery& surface) {
  double farthest = 0.0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.cut[static_cast<std::size_t>(t)]) continue;
    for (const Eigen::Vector3d& place : cornersOf(mesh, t)) {
      farthest = std::max(farthest, (surface.closest(place).position - place).norm());
    }
  }
  return farthest;
}

TEST(CutQuality, TrianglesOfAWellShapedBodyStayWellShaped) {
  const MeshTopology sponge = shippedSponge();
  Angles skin, faces;
  forEachPlaneCut(sponge, 60, 1, [&](const CutPatch&, const MeshTopology& cut) {
    skin.add(anglesOfSkin(cut));
    faces.add(anglesOfFaces(cut));
  });
  ASSERT_GT(skin.degrees.size(), 1000u);
  EXPECT_LE(skin.shareBelow(10.0), 0.01);
  EXPECT_LE(skin.shareBelow(20.0), 0.05);
  EXPECT_LE(faces.shareBelow(10.0), 0.01);
  EXPECT_LE(faces.shareBelow(20.0), 0.05);
}

/// Against the parts of the same triangles without remeshing.
TEST(CutQuality, TrianglesOfABadlyShapedBodyGetNoWorse) {
  MeshTopology stretched = loadMesh(test::testData("spot.obj"));
  stretched.rest_vertices.col(2) *= 5.0;
  stretched.rest_vertices = inSinglePrecision(stretched.rest_vertices);
  forEachPlaneCut(stretched, 20, 2, [&](const CutPatch& patch, const MeshTopology& cut) {
    const Angles parts = anglesOfParts(stretched, patch), skin = anglesOfSkin(cut);
    EXPECT_LE(skin.shareBelow(10.0), parts.shareBelow(10.0));
    EXPECT_LE(skin.shareBelow(20.0), parts.shareBelow(20.0));
  });
}

/// The corners of the skin before a cut stay within the bound of remeshing, 1/2000 of the diagonal, and that
/// of snapping, 1/20,000. New corners lie on the skin as it is while it moves: within twice the first bound.
TEST(CutQuality, SurfaceStaysWhereItIs) {
  for (const MeshTopology& mesh : {torusSurface(), loadMesh(test::testData("spot.obj"))}) {
    const double diagonal = diagonalOf(mesh);
    const ClosestPointQuery uncut(mesh.rest_vertices, mesh.triangles);
    forEachPlaneCut(mesh, 20, 3, [&](const CutPatch&, const MeshTopology& cut) {
      EXPECT_EQ(faultOf(cut, volumeOf(mesh)), "");
      const ClosestPointQuery after(cut.rest_vertices, cut.triangles);
      EXPECT_LT(farthestOfSkin(mesh, after), (1.0 / 2000.0 + 1.0 / 20000.0) * diagonal);
      EXPECT_LT(farthestOfSkin(cut, uncut), diagonal / 1000.0);
    });
  }
}

/// Their sharp edges are far apart from the chords across them.
TEST(CutQuality, BoxesKeepTheirVolume) {
  for (const Eigen::Vector3i& cells : {Eigen::Vector3i(10, 5, 2), Eigen::Vector3i(1, 1, 1)}) {
    const MeshTopology box = meshTopology(test::boxMesh({0.2, 0.1, 0.04}, {0.0, 0.0, 0.0}, cells));
    forEachPlaneCut(box, 300, 8, [&](const CutPatch&, const MeshTopology& cut) {
      EXPECT_EQ(faultOf(cut, volumeOf(box)), "");
    });
  }
}

TEST(CutQuality, OnlyVerticesOfCrossedTrianglesAreReplaced) {
  const MeshTopology torus = torusSurface();
  forEachPlaneCut(torus, 20, 4, [&](const CutPatch& patch, const MeshTopology& cut) {
    std::vector<bool> stays(torus.vertex_parents.size(), false);
    for (Eigen::Index v = 0; v < cut.rest_vertices.rows(); ++v) {
      const int parent = cut.vertex_parents[static_cast<std::size_t>(v)];
      if (parent < 0) continue;
      stays[static_cast<std::size_t>(parent)] = true;
      EXPECT_EQ(cut.rest_vertices.row(v), torus.rest_vertices.row(parent));
    }
    const std::vector<bool> crossed = cornersOfCrossedTriangles(torus, patch);
    for (std::size_t v = 0; v < stays.size(); ++v) EXPECT_TRUE(stays[v] || crossed[v]) << "vertex " << v;
  });
}

TEST(CutQuality, WallsStayMirrorImagesAcrossRepeatedCuts) {
  for (const MeshTopology& mesh : {shippedSponge(), torusSurface()}) {
    RandomPatches patches(mesh.rest_vertices, mesh.triangles, 5);
    int made = 0;
    for (int k = 0; k < 20; ++k) {
      MeshTopology before = mesh;
      for (const PatchKind kind : {PatchKind::kPartialPlane, PatchKind::kSweptBlade, PatchKind::kPlane}) {
        const SurfaceCut cut = cutSurface(before, patches.next(kind));
        if (cut.outcome != CutOutcome::kCut) continue;
        ++made;
        EXPECT_EQ(facesWithoutMirrorImage(cut.mesh), 0) << "cut " << k;
        before = cut.mesh;
      }
    }
    EXPECT_GT(made, 30);
  }
}

TEST(CutQuality, SeamsStayAndLinearTexturesStayLinear) {
  MeshTopology sponge = shippedSponge();
  const double seam =
      0.3 * sponge.rest_vertices.col(0).minCoeff() + 0.7 * sponge.rest_vertices.col(0).maxCoeff();
  sponge.texture_coordinates.setZero(3 * sponge.triangles.rows(), 3);
  const auto textureAt = [](const Eigen::RowVector3d& p, bool beyond) {
    return Eigen::RowVector3d(3.0 * p.x() - p.z(), 2.0 * p.y() + p.z() + (beyond ? 5.0 : 0.0), 0.0);
  };
  const auto isBeyond = [seam](const MeshTopology& mesh, Eigen::Index t) {
    const Corners corners = cornersOf(mesh, t);
    return (corners[0] + corners[1] + corners[2]).x() / 3.0 > seam;
  };
  for (Eigen::Index t = 0; t < sponge.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sponge.texture_coordinates.row(3 * t + k) =
          textureAt(sponge.rest_vertices.row(sponge.triangles(t, k)), isBeyond(sponge, t));
    }
  }
  // A seam moves with vertices that are snapped: by 1/20000 of the diagonal, where the texture's slope is 4.
  const double distance = 4.0 * diagonalOf(sponge) / 20000.0;
  forEachPlaneCut(sponge, 20, 6, [&](const CutPatch&, const MeshTopology& cut) {
    for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) {
      if (cut.cut[static_cast<std::size_t>(t)]) continue;
      const bool beyond = cut.texture_coordinates(3 * t, 1) > 2.5;
      for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d expected = textureAt(cut.rest_vertices.row(cut.triangles(t, k)), beyond);
        EXPECT_LT((cut.texture_coordinates.row(3 * t + k) - expected).norm(), distance);
      }
    }
  });
}

TEST(CutQuality, SameCutGivesTheSameMesh) {
  const MeshTopology sponge = shippedSponge();
  forEachPlaneCut(sponge, 5, 7, [&](const CutPatch& patch, const MeshTopology& cut) {
    expectSame(cutSurface(sponge, patch).mesh, cut);
  });
}

}  // namespace
}  // namespace softbody
