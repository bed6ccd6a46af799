#include <test_support/gtest.h>

#include <numeric>

#include "fixtures/box_meshes.h"
#include "fixtures/model_files.h"
#include "shells/body_choice.h"

namespace softbody {
namespace {

using test::boxMesh;
using test::insideOut;
using test::together;

struct Chosen {
  WeldedSurface surface;
  std::string said;

  double volume() const { return enclosedVolume(surface.mesh.vertices, surface.mesh.triangles); }
  double side() const {
    return (surface.mesh.vertices.colwise().maxCoeff() - surface.mesh.vertices.colwise().minCoeff())
        .maxCoeff();
  }
  bool says(const std::string& part) const { return said.find(part) != std::string::npos; }
};

Chosen choose(const TriangleMesh& mesh, const BodyChoice& choice = {}) {
  Warnings warnings;
  Chosen chosen{chosenBody(repairSurface({mesh, {}}, "mesh", &warnings), choice, "mesh", &warnings), ""};
  chosen.said =
      std::accumulate(warnings.begin(), warnings.end(), std::string(),
                      [](const std::string& all, const std::string& one) { return all + one + "\n"; });
  EXPECT_TRUE(isClosed(chosen.surface.mesh.triangles)) << chosen.said;
  EXPECT_EQ(chosen.surface.vertex_parents.size(),
            static_cast<std::size_t>(chosen.surface.mesh.vertices.rows()));
  for (Eigen::Index v = 0; v < chosen.surface.mesh.vertices.rows(); ++v) {
    const int parent = chosen.surface.vertex_parents[static_cast<std::size_t>(v)];
    if (parent < 0 || choice.length_m > 0.0) continue;
    EXPECT_EQ(chosen.surface.mesh.vertices.row(v), mesh.vertices.row(parent));
  }
  return chosen;
}

const TriangleMesh kBox = boxMesh({0.2, 0.1, 0.04});
constexpr double kVolume = 0.2 * 0.1 * 0.04;

TEST(ChosenBody, ACleanBoxStaysAsItIs) {
  const Chosen chosen = choose(kBox);
  EXPECT_EQ(chosen.surface.mesh.triangles, kBox.triangles);
  EXPECT_EQ(chosen.said, "");
}

TEST(ChosenBody, ABoxThatIsInsideOutIsTurned) {
  const Chosen chosen = choose(insideOut(kBox));
  EXPECT_NEAR(chosen.volume(), kVolume, 1e-12);
  EXPECT_TRUE(chosen.says(" triangles faced inward and were flipped")) << chosen.said;
}

/// Whatever way each shell faces in the file.
TEST(ChosenBody, NestingDecidesWhatIsSolid) {
  const TriangleMesh cavity = boxMesh({0.16, 0.06, 0.02}), core = boxMesh({0.1, 0.03, 0.01});
  const double hollow = kVolume - 0.16 * 0.06 * 0.02, with_core = hollow + 0.1 * 0.03 * 0.01;
  for (const bool turn : {false, true}) {
    const auto turned = [turn](const TriangleMesh& mesh) { return turn ? insideOut(mesh) : mesh; };
    EXPECT_NEAR(choose(together({kBox, turned(cavity)})).volume(), hollow, 1e-12);
    EXPECT_NEAR(choose(together({turned(core), cavity, turned(kBox)})).volume(), with_core, 1e-12);
  }
}

/// The back has the other diagonals, as an exporter gives it that begins at another corner.
TEST(ChosenBody, OfATwoSidedSurfaceOneSideStays) {
  TriangleMesh back = boxMesh({0.2, 0.1, 0.04}, {0, 0, 0}, {5, 4, 3});
  back.vertices.col(0) *= -1.0;  // mirrored: it faces inward, and its diagonals cross the front's
  Warnings ignored;
  back = repairSurface({back, {}}, "back", &ignored).mesh;
  const Chosen chosen = choose(together({kBox, back}));
  EXPECT_NEAR(chosen.volume(), kVolume, 1e-12);
  EXPECT_EQ(chosen.surface.mesh.triangles.rows(), kBox.triangles.rows());
  EXPECT_TRUE(chosen.says("1 shells that repeat another one were dropped")) << chosen.said;
}

TEST(ChosenBody, CrossingShellsAreUnited) {
  const Chosen chosen = choose(together({kBox, boxMesh({0.1, 0.06, 0.1}, {0.02, 0.01, 0.003})}));
  EXPECT_NEAR(chosen.volume(), kVolume + 0.1 * 0.06 * 0.06, 1e-9);
  EXPECT_TRUE(chosen.says("2 crossing shells were united")) << chosen.said;
}

TEST(ChosenBody, AFloorAndASpeckAreDroppedAndTheLengthIsThatOfTheBody) {
  const TriangleMesh floor{(Points(4, 3) << -1, -1, -.02, 1, -1, -.02, 1, 1, -.02, -1, 1, -.02).finished(),
                           (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished()};
  const TriangleMesh speck{(Points(3, 3) << 3, 0, 0, 3.01, 0, 0, 3, 0.01, 0).finished(),
                           (Triangles(1, 3) << 0, 1, 2).finished()};
  const Chosen chosen = choose(together({speck, kBox, floor}), {"", 1.0, 0.1});
  EXPECT_NEAR(chosen.side(), 0.1, 1e-12);
  EXPECT_NEAR(chosen.volume(), kVolume / 8.0, 1e-12);
  EXPECT_EQ(chosen.surface.vertex_parents.front(), 3);
  EXPECT_TRUE(
      chosen.says("2 surfaces that enclose no volume were dropped; the largest: 2 triangles, 1000.0 x "
                  "1000.0 x 0.0 mm"))
      << chosen.said;
}

TEST(ChosenBody, ASmallBodyBesideItIsDroppedAndSaid) {
  const Chosen chosen = choose(together({boxMesh({0.02, 0.02, 0.02}, {0.3, 0, 0}), kBox}), {"", 1.0, 0.0});
  EXPECT_NEAR(chosen.volume(), kVolume, 1e-12);
  EXPECT_TRUE(chosen.says("holds 2 separate bodies; taken: shell 1:")) << chosen.said;
  EXPECT_TRUE(
      chosen.says("shell 2: 20.0 x 20.0 x 20.0 mm at (300.0, 0.0, 0.0) mm, 8 cm3, 1.0 % of the volume"))
      << chosen.said;
}

TEST(ChosenBody, OfBodiesOfSimilarSizeAChoiceIsAskedAndTaken) {
  const TriangleMesh two = together({boxMesh({0.2, 0.1, 0.02}, {0.3, 0, 0}), kBox});
  const std::string said = complaint([&] { choose(two); });
  EXPECT_TRUE(says(said, "mesh: holds 2 separate bodies; choose with prepare_model --shell"));
  EXPECT_TRUE(says(said, "\n  shell 2: 200.0 x 100.0 x 20.0 mm at (300.0, 0.0, 0.0) mm, 400 cm3, 33.3 %"));
  EXPECT_NEAR(choose(two, {"largest", 1.0, 0.0}).volume(), kVolume, 1e-12);
  EXPECT_NEAR(choose(two, {"2", 1.0, 0.0}).volume(), kVolume / 2.0, 1e-12);
  EXPECT_NEAR(choose(two, {"all", 1.0, 0.0}).volume(), 1.5 * kVolume, 1e-12);
  EXPECT_TRUE(says(complaint([&] { choose(two, {"3", 1.0, 0.0}); }), "there is no shell 3"));
}

TEST(ChosenBody, DustIsDroppedQuickly) {
  TriangleMesh mesh = kBox;
  for (int k = 0; k < 300; ++k)
    mesh = together({mesh, boxMesh({1e-3, 1e-3, 1e-3}, {0.2, 0.002 * k, 0}, {1, 1, 1})});
  const Chosen chosen = choose(mesh);
  EXPECT_NEAR(chosen.volume(), kVolume, 1e-12);
  EXPECT_TRUE(chosen.says("shells were dropped as dust")) << chosen.said;
}

TEST(ChosenBody, OfManyEqualShellsTheFirstStay) {
  TriangleMesh mesh = boxMesh({0.01, 0.01, 0.01});
  for (int k = 1; k < 150; ++k)
    mesh = together({mesh, boxMesh({0.01, 0.01, 0.01}, {0.02 * k, 0, 0}, {1, 1, 1})});
  EXPECT_NEAR(choose(mesh, {"all", 1.0, 0.0}).volume(), 100 * 1e-6, 1e-12);
}

TEST(WholeBody, KeepsSurfacesThatEncloseNothing) {
  TriangleMesh fin{(Points(3, 3) << 3, 0, 0, 3.1, 0, 0, 3, 0.1, 0).finished(),
                   (Triangles(1, 3) << 0, 1, 2).finished()};
  Warnings warnings;
  const WeldedSurface whole = wholeBody(
      repairSurface({together({fin, insideOut(kBox)}), {}}, "mesh", &warnings), 1.0, "mesh", &warnings);
  EXPECT_EQ(whole.mesh.vertices.rows(), 3 + kBox.vertices.rows());
  EXPECT_NEAR(enclosedVolume(whole.mesh.vertices, whole.mesh.triangles), kVolume, 1e-9);
}

}  // namespace
}  // namespace softbody
