#include <test_support/gtest.h>

#include <set>

#include "cutting/fixtures/blade_scene.h"
#include "cutting/fixtures/cut_visual_body.h"
#include "cutting/fixtures/same_topology.h"

namespace softbody {
namespace {

using testing::bladeAt;
using testing::Scene;

TEST(CuttableBody, TwoStrokesThatCrossLeaveFourPiecesAndAreUndoneOneByOne) {
  Scene scene;
  const TetTopology uncut = scene.surface.volume();
  scene.sweep(0.05, -0.006, 3e-4, 0.005);
  scene.sweep(-0.006, 0.05, 3e-4, 0.005);
  const Eigen::AngleAxisd turn(0.6, Eigen::Vector3d::UnitZ());
  for (int k = 0; k <= 56; ++k) scene.move(bladeAt(0.05 - 0.001 * k) * turn);
  EXPECT_EQ(scene.visualPieces(), 4u);
  EXPECT_EQ(scene.tetPieces(), 4u);
  EXPECT_EQ(std::set<std::uint32_t>(scene.strokes.begin(), scene.strokes.end()).size(), 2u);

  std::string reason;
  for (const std::size_t pieces : {2u, 1u}) {
    const Cut undo = scene.surface.edit(CutKind::kUndo);
    ASSERT_TRUE(scene.surface.apply(undo, scene.simulator.state(), &reason)) << reason;
    scene.checkAgreement();
    EXPECT_EQ(scene.visualPieces(), pieces);
  }
  EXPECT_EQ(scene.simulator.topology().rest_vertices, uncut.rest_vertices);
  EXPECT_EQ(scene.simulator.topology().tets, uncut.tets);
  scene.step();
  EXPECT_FALSE(scene.surface.apply(scene.surface.edit(CutKind::kUndo), scene.simulator.state(), &reason));
  EXPECT_EQ(reason, "there is no cut to undo");
}

TEST(CuttableBody, ABladeThatIsInTheBodyDuringAnUndoDoesNotMakeItsCutAgain) {
  Scene scene;
  scene.sweep(0.05, 0.01, 0.0, 0.0);
  const Cut undo = scene.surface.edit(CutKind::kUndo);
  std::string reason;
  ASSERT_TRUE(scene.surface.apply(undo, scene.simulator.state(), &reason)) << reason;
  const int cuts = scene.cuts;
  scene.sweep(0.01, 0.009, 5e-4, 0.0);
  scene.sweep(0.009, 0.05, 0.0, 0.0);
  EXPECT_EQ(scene.cuts, cuts);
  scene.sweep(0.05, 0.01, 0.0, 0.0);
  EXPECT_GT(scene.cuts, cuts) << "the blade does not cut when it returns";
}

TEST(CuttableBody, APreviewChangesNothingAndGivesThePieces) {
  Scene scene;
  const CutPreview preview =
      scene.surface.preview(testing::planePatch({0.06, 0.05, 0.015}, {1.0, 0.0, 0.0}, 1.0));
  EXPECT_EQ(preview.refusal, "");
  ASSERT_EQ(preview.volumes.size(), 2u);
  EXPECT_NEAR(preview.volumes[0] + preview.volumes[1], 0.96 * 0.96 * 0.96 * 6e-4, 1e-8);
  EXPECT_GT(preview.volumes[0], preview.volumes[1]);
  EXPECT_EQ(scene.surface.volume().revision, 0u);
  const std::string missed =
      scene.surface.preview(testing::planePatch({60.0, 0.05, 0.015}, {1.0, 0.0, 0.0}, 1.0)).refusal;
  for (const char* words : {"does not pass through", "body extends from (", "m in the rest frame", "(60, "})
    EXPECT_TRUE(says(missed, words));
}

/// An exception between the edits of tets and mesh: the state for the binding is incomplete.
TEST(CuttableBody, AnEditThatFailsHalfwayChangesNothing) {
  Scene scene;
  scene.sweep(0.05, 0.012, 0.0, 0.0);
  const TetTopology tets = scene.surface.volume();
  const MeshTopology mesh = scene.surface.surface().topology();
  const Cut cut = scene.surface.separateCut(testing::planePatch({0.04, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
  MeshState broken = scene.simulator.state();
  broken.confidence.pop_back();
  std::string reason;
  EXPECT_THROW(scene.surface.apply(cut, broken, &reason), std::invalid_argument);
  EXPECT_EQ(scene.surface.volume().revision, tets.revision);
  EXPECT_EQ(scene.surface.volume().tets, tets.tets);
  EXPECT_EQ(scene.surface.surface().topology().triangles, mesh.triangles);
  ASSERT_TRUE(scene.surface.apply(cut, scene.simulator.state(), &reason)) << reason;
  scene.checkAgreement();
  EXPECT_EQ(scene.visualPieces(), 2u);
}

TEST(CuttableBody, AnEditThatTheFollowerCannotMakeChangesNothing) {
  bool fails = false;
  CuttableBody body(testing::visualSponge(), testing::sponge(), {}, [&fails](const TetEdits&) {
    if (fails) throw std::runtime_error("cannot follow");
  });
  const auto apply = [&body](const Cut& cut) {
    std::string reason;
    return body.apply(cut, testing::stateOf(body.volume(), body.volume().rest_vertices), &reason);
  };
  const auto plane = [&body](double x) {
    return body.separateCut(testing::planePatch({x, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
  };
  ASSERT_TRUE(apply(plane(0.05)));
  const TetTopology tets = body.volume();
  const MeshTopology mesh = body.surface().topology();
  fails = true;
  EXPECT_THROW(apply(plane(0.1)), std::runtime_error);
  EXPECT_THROW(apply(body.edit(CutKind::kUndo)), std::runtime_error);
  EXPECT_THROW(body.adopt({}), std::runtime_error);
  EXPECT_EQ(body.edits().strokes.size(), 1u);
  EXPECT_EQ(body.volume().revision, tets.revision);
  EXPECT_EQ(body.surface().topology().revision, tets.revision);
  testing::expectSame(body.volume(), tets);
  testing::expectSame(body.surface().topology(), mesh);
  fails = false;
  EXPECT_TRUE(apply(plane(0.1)));
}

TEST(CuttableBody, AnEditThatIsTakenBackHasNeverBeenMade) {
  Scene scene;
  scene.sweep(0.05, 0.012, 0.0, 0.0);  // a stroke of several cuts
  const TetTopology tets = scene.surface.volume();
  const MeshTopology mesh = scene.surface.surface().topology();
  const Points shown = scene.surface.surface().apply(scene.simulator.state()).vertices;
  scene.follows = false;
  std::string reason;
  for (int k = 0; k < 2; ++k) {
    const Cut cut = scene.surface.separateCut(testing::planePatch({0.03, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0));
    ASSERT_TRUE(scene.surface.apply(cut, scene.simulator.state(), &reason)) << reason;
    scene.surface.takeBack();
    scene.surface.takeBack();
    scene.checkAgreement();
    testing::expectSame(scene.surface.volume(), tets);
    testing::expectSame(scene.surface.surface().topology(), mesh);
    EXPECT_EQ(scene.surface.surface().apply(scene.simulator.state()).vertices, shown);
  }
  scene.follows = true;
  scene.sweep(0.012, 0.05, 0.0, 0.0);
  scene.sweep(0.05, -0.006, 0.0, 0.0);
  EXPECT_EQ(scene.visualPieces(), 2u) << "nothing can be cut after a cut was taken back";
}

}  // namespace
}  // namespace softbody
