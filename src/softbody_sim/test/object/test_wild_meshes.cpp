#include <test_support/gtest.h>

#include <numeric>

#include "fixtures/object_model_test.h"
#include "report/model_trial.h"
#include "report/model_verdict.h"

namespace softbody {
namespace {

/// A file of shared/data/wild/meshes; its README.md says what it is and what is right.
struct WildMesh {
  const char* file;
  double volume_cm3;
  const char* said = "";  ///< part of a warning
};

class WildMeshes : public test::ObjectModelTest, public ::testing::WithParamInterface<WildMesh> {};

INSTANTIATE_TEST_SUITE_P(
    SharedData, WildMeshes,
    ::testing::Values(
        WildMesh{"plain.obj", 800}, WildMesh{"unused_outside.obj", 800, "1 vertices that no triangle uses"},
        WildMesh{"needle.obj", 800, "1 vertices of triangles without area"}, WildMesh{"bom_plain.obj", 800},
        WildMesh{"bom.stl", 800}, WildMesh{"backslash.obj", 800},
        WildMesh{"doublesided.obj", 800, "1 shells that repeat another one"}, WildMesh{"hollow.obj", 608},
        WildMesh{"overlap.obj", 974.6, "2 crossing shells were united"},
        WildMesh{"holes.obj", 800, " holes were filled"}, WildMesh{"L0.obj", 600}, WildMesh{"L2.obj", 600},
        WildMesh{"with_plane.obj", 800, "1 surfaces that enclose no volume"},
        WildMesh{"with_speck.obj", 800, "1 surfaces that enclose no volume"}, WildMesh{"upper.stl", 800},
        WildMesh{"indented.stl", 800}, WildMesh{"endsolid2.stl", 800}, WildMesh{"solid_binary_tail.stl", 800},
        WildMesh{"nan_normal.ply", 800}, WildMesh{"vt_nan.obj", 800}, WildMesh{"two_corner_face.obj", 800},
        WildMesh{"coff.off", 800}, WildMesh{"wedge_texcoord.ply", 800}),
    [](const auto& info) {
      std::string name = info.param.file;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

ObjectDescription wild(const std::string& file) {
  ObjectDescription description;
  description.visual_mesh = test::sharedData("wild/meshes/" + file);
  return description;
}

TEST_P(WildMeshes, DISABLED_GiveTheRightBodyWhichCanBeCut) {
  const ObjectModel model = buildObjectModel(wild(GetParam().file));
  EXPECT_NEAR(1e6 * enclosedVolume(model.visual.rest_vertices, model.visual.triangles), GetParam().volume_cm3,
              0.01 * GetParam().volume_cm3);
  test::expectSound(model);
  const std::string said = std::accumulate(model.warnings.begin(), model.warnings.end(), std::string());
  EXPECT_TRUE(says(said, GetParam().said));
  const ModelTrial trial = tryModel(model);
  EXPECT_EQ(trial.failure, "");
  EXPECT_TRUE(trial.refused_cuts.empty()) << trial.refused_cuts.front();
  EXPECT_LT(trial.volume_error, 1e-3);
  EXPECT_EQ(trial.crossings, 0);
}

using WildBodies = test::ObjectModelTest;

TEST_F(WildBodies, DISABLED_OfTwoEqualBoxesAChoiceIsAsked) {
  ObjectDescription description = wild("gap10.obj");
  EXPECT_TRUE(says(complaint([&] { buildObjectModel(description); }), "holds 2 separate bodies"));
  description.body.shell = "2";
  const ObjectModel model = buildObjectModel(description);
  EXPECT_NEAR(enclosedVolume(model.visual.rest_vertices, model.visual.triangles), 8e-4, 1e-6);
}

TEST_F(WildBodies, DISABLED_TheLengthIsThatOfTheBodyAlone) {
  for (const char* file : {"with_plane.obj", "with_speck.obj"}) {
    ObjectDescription description = wild(file);
    description.body.length_m = 0.1;
    const Points& rest = buildObjectModel(description).visual.rest_vertices;
    EXPECT_NEAR((rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff(), 0.1, 1e-9) << file;
  }
}

/// The same prism, whichever corner its caps begin with.
TEST_F(WildBodies, DISABLED_APolygonsFirstCornerDoesNotMatter) {
  const auto cageVolume = [](const char* file) {
    const TetTopology volume = buildObjectModel(wild(file)).volume;
    return enclosedVolume(volume.rest_vertices, volume.surface);
  };
  EXPECT_NEAR(cageVolume("L0.obj"), cageVolume("L2.obj"), 0.02 * 6e-4);
}

}  // namespace
}  // namespace softbody
