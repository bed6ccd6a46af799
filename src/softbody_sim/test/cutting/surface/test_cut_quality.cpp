#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cutting/fixtures/cut_shapes_of.h"
#include "cutting/fixtures/random_patches.h"
#include "cutting/fixtures/same_topology.h"
#include "cutting/fixtures/surface_meshes.h"
#include "cutting/surface/surface_cut.h"
#include "fixtures/model_files.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody {
namespace {

using namespace softbody::testing;

MeshTopology shippedSponge() {
  return loadMesh(SOFTBODY_SOURCE_DIR "/../softbody_bringup/config/sponge.obj");
}

/// Calls visit(patch, cut mesh) for random cuts through the whole mesh.
template <class Visit>
void forEachPlaneCut(const MeshTopology& mesh, int count, unsigned seed, const Visit& visit) {
  RandomPatches patches(mesh.rest_vertices, mesh.triangles, seed);
  for (int k = 0; k < count; ++k) {
    const CutPatch patch = patches.next(PatchKind::kPlane);
    const SurfaceCut cut = cutSurface(mesh, patch);
    SCOPED_TRACE(fmt::format("cut {}", k));
    if (cut.outcome == CutOutcome::kCut) visit(patch, cut.mesh);
  }
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

/// Both ways, and the volume.
TEST(CutQuality, SurfaceStaysWhereItIs) {
  const MeshTopology torus = torusSurface();
  const double distance = diagonalOf(torus) / 1000.0;
  const ClosestPointQuery uncut(torus.rest_vertices, torus.triangles);
  forEachPlaneCut(torus, 20, 3, [&](const CutPatch&, const MeshTopology& cut) {
    EXPECT_EQ(faultOf(cut, volumeOf(torus)), "");
    const ClosestPointQuery after(cut.rest_vertices, cut.triangles);
    for (const auto& vertex : torus.rest_vertices.rowwise()) {
      const Eigen::Vector3d place = vertex.transpose();
      EXPECT_LT((after.closest(place).position - place).norm(), distance);
    }
    for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) {
      if (cut.cut[static_cast<std::size_t>(t)]) continue;
      const Corners corners = cornersOf(cut, t);
      for (const Eigen::Vector3d& place : corners) {
        EXPECT_LT((uncut.closest(place).position - place).norm(), distance);
      }
    }
  });
}

TEST(CutQuality, VerticesThatStayKeepPlaceAndParent) {
  const MeshTopology torus = torusSurface();
  forEachPlaneCut(torus, 20, 4, [&](const CutPatch& patch, const MeshTopology& cut) {
    const Corners frame{patch.vertices.row(0), patch.vertices.row(1), patch.vertices.row(2)};
    const Eigen::Vector3d normal = (frame[1] - frame[0]).cross(frame[2] - frame[0]).normalized();
    std::vector<bool> stays(torus.vertex_parents.size(), false);
    for (Eigen::Index v = 0; v < cut.rest_vertices.rows(); ++v) {
      const int parent = cut.vertex_parents[static_cast<std::size_t>(v)];
      if (parent < 0) continue;
      stays[static_cast<std::size_t>(parent)] = true;
      EXPECT_EQ(cut.rest_vertices.row(v), torus.rest_vertices.row(parent));
    }
    for (Eigen::Index v = 0; v < torus.rest_vertices.rows(); ++v) {
      const double away = std::abs(normal.dot(torus.rest_vertices.row(v).transpose() - frame[0]));
      if (away > 0.04) EXPECT_TRUE(stays[static_cast<std::size_t>(v)]) << away << " m from the cut";
    }
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
