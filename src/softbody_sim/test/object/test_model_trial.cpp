#include <sys/wait.h>
#include <test_support/gtest.h>

#include <cstdlib>

#include "cage/volume_maker.h"
#include "fixtures/box_meshes.h"
#include "fixtures/object_model_test.h"
#include "report/model_trial.h"
#include "report/model_verdict.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"

namespace softbody {
namespace {

using test::ObjectModelTest;

TEST_F(ObjectModelTest, AGoodModelIsCutAndComesToRest) {
  const ModelTrial trial = tryModel(buildObjectModel(describe(test::torus(0.1, 0.03, 60, 24))));
  EXPECT_EQ(trial.failure, "");
  EXPECT_TRUE(trial.refused_cuts.empty());
  EXPECT_LT(trial.volume_error, 1e-4);
  EXPECT_EQ(trial.crossings, 0);
  EXPECT_NEAR(trial.simulated_s, 1.0, 1e-6);
  EXPECT_EQ(trial.inverted, 0);
  EXPECT_GT(trial.energy_growth, 0.0);
  EXPECT_LE(trial.energy_growth, 1.0);
  EXPECT_GT(trial.cost.total(), 0.0);
  EXPECT_LT(worst(judge(trial, 2880)), Verdict::kBad);
}

TEST_F(ObjectModelTest, ACutThroughACavityClosesAsARing) {
  const ObjectModel model = buildObjectModel(
      describe(test::together({test::boxMesh({0.2, 0.1, 0.04}), test::boxMesh({0.16, 0.06, 0.02})})));
  const CuttableBody surface(model.visual, model.volume);
  const MeshTopology pieces =
      surface.preview(planePatch({0.013, 0, 0}, Eigen::Vector3d::UnitX(), model.visual.rest_vertices)).pieces;
  std::vector<Eigen::Index> walls;
  for (Eigen::Index f = 0; f < pieces.triangles.rows(); ++f)
    if (pieces.cut[static_cast<std::size_t>(f)]) walls.push_back(f);
  EXPECT_NEAR(areaOf({pieces.rest_vertices, Triangles(pieces.triangles(walls, Eigen::all))}),
              2.0 * (0.1 * 0.04 - 0.06 * 0.02), 1e-6);
}

/// A vertex that was pulled through the other side of the tube.
TEST_F(ObjectModelTest, TrianglesThatCrossAreNamedWithTheirPlace) {
  TriangleMesh torus = test::torus(0.1, 0.03, 60, 24);
  torus.vertices.row(0) << 0.06, 0.0, 0.0;  // was at x = 0.13
  const ModelTrial trial = tryModel(buildObjectModel(describe(torus)));
  EXPECT_GT(trial.crossings, 0);
  EXPECT_NEAR(trial.crossing.x(), 0.07, 0.03);
  EXPECT_NEAR(trial.crossing.y(), 0.0, 0.02);
  EXPECT_GE(worst(judge(trial, 2880)), Verdict::kLookHere);
}

TEST_F(ObjectModelTest, ATwistedMeshCannotBeUsedAndTheTrialSaysWhy) {
  ObjectModel model = buildObjectModel(describe(test::block()));
  model.visual.triangles.row(7).reverseInPlace();
  const std::vector<Judgement> judgements = judge(tryModel(model), 2880);
  EXPECT_EQ(worst(judgements), Verdict::kBad);
  EXPECT_TRUE(says(judgements.front().sentence, "not a closed oriented surface"));
}

TEST(ModelTrial, EachFailureIsBadAndASlowFrameOffersSimpler) {
  ModelTrial good;
  good.simulated_s = 1.0;
  EXPECT_EQ(worst(judge(good, 1000)), Verdict::kGood);
  ModelTrial refused = good, lossy = good, inverted = good, exploding = good, slow = good;
  refused.refused_cuts = {"along x = 1.0 mm: because"};
  lossy.volume_error = 0.1;
  inverted.inverted = 1;
  exploding.energy_growth = 2.0;
  slow.cost.surface_ms = 300.0;
  for (const ModelTrial& trial : {refused, lossy, inverted, exploding})
    EXPECT_EQ(worst(judge(trial, 1000)), Verdict::kBad);
  EXPECT_EQ(worst(judge(slow, 180000)), Verdict::kLookHere);
  EXPECT_TRUE(says(judge(slow, 180000).back().sentence, "give --simplify 10000"));
}

TEST_F(ObjectModelTest, ABadVerdictHasItsOwnExitCode) {
  const std::string mesh = describe(test::block()).visual_mesh;
  const auto exitCode = [&](const std::string& options) {
    const std::string program = SOFTBODY_SOURCE_DIR "/../../catkin_ws/devel/lib/softbody_sim/prepare_model ";
    return WEXITSTATUS(std::system(
        (program + mesh + " --output " + folder_.file("out") + " " + options + " 2> /dev/null").c_str()));
  };
  EXPECT_EQ(exitCode(""), 0);
  EXPECT_EQ(exitCode("--scale 1000"), 3);
  EXPECT_EQ(exitCode("--shell 2 --thickness 1"), 1);
  EXPECT_EQ(exitCode("--shell few"), 2);
}

}  // namespace
}  // namespace softbody
