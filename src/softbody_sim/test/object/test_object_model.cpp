#include <test_support/gtest.h>

#include <limits>

#include <set>

#include "cage/enclosure.h"
#include "fixtures/object_model_test.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/object_model.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

using test::expectSound;
using test::ObjectModelTest;
using test::stretched;

int cageVertexCount(const TetTopology& volume) {
  const auto corners = volume.surface.reshaped();
  return static_cast<int>(std::set<int>(corners.begin(), corners.end()).size());
}

TEST_F(ObjectModelTest, MadeVolumesEncloseTheVisualMeshWithNearUniformCages) {
  const TriangleMesh torus = test::torus(0.1, 0.03, 60, 24);
  for (const TriangleMesh& mesh : {torus, stretched(torus, 1.0, 1.0, 0.1), stretched(torus, 3.0, 0.5, 1.0)}) {
    const ObjectModel model = buildObjectModel(describe(mesh));
    expectSound(model);
    EXPECT_GE(cageVertexCount(model.volume), 170);
    EXPECT_LE(cageVertexCount(model.volume), 420);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
  }
}

TEST_F(ObjectModelTest, CageVerticesAreAboutAsManyAsAskedFor) {
  const ObjectDescription description = describe(test::torus(0.1, 0.03, 60, 24));
  for (const int wanted : {100, 400}) {
    VolumeSettings settings;
    settings.cage_vertices = wanted;
    EXPECT_NEAR(cageVertexCount(buildObjectModel(description, settings).volume), wanted, 0.25 * wanted);
  }
}

TEST_F(ObjectModelTest, AMeshWithHolesIsEnclosedToo) {
  TriangleMesh mesh = test::torus(0.1, 0.03, 60, 24);
  mesh.triangles = Triangles(mesh.triangles.bottomRows(mesh.triangles.rows() - 20));
  const ObjectModel model = buildObjectModel(describe(mesh));
  expectSound(model);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_TRUE(says(model.warnings[0], "1 holes were filled"));
}

TEST_F(ObjectModelTest, AGivenCageIsFilled) {
  ObjectDescription description = describe(test::torus(0.1, 0.02, 60, 24));
  writeObj(folder_.file("cage.obj"), test::torus(0.1, 0.03, 24, 8));
  description.cage_mesh = folder_.file("cage.obj");
  const ObjectModel model = buildObjectModel(description);
  expectSound(model);
  const TriangleMesh cage = test::torus(0.1, 0.03, 24, 8);
  EXPECT_NEAR(tetVolumes(model.volume.rest_vertices, model.volume.tets).sum(),
              enclosedVolume(cage.vertices, cage.triangles),
              0.15 * enclosedVolume(cage.vertices, cage.triangles));
}

TEST_F(ObjectModelTest, ACageOfTwelveTrianglesIsFilledWithMoreThanItsCorners) {
  ObjectDescription description = describe(test::torus(0.05, 0.01, 60, 24));
  folder_.write(
      "cage.obj",
      "v -.1 -.1 -.02\nv .1 -.1 -.02\nv .1 .1 -.02\nv -.1 .1 -.02\nv -.1 -.1 .02\nv .1 -.1 .02\nv .1 .1 .02\n"
      "v -.1 .1 .02\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  description.cage_mesh = folder_.file("cage.obj");
  const ObjectModel model = buildObjectModel(description);
  expectSound(model);
  EXPECT_GE(cageVertexCount(model.volume), 80);
}

TEST_F(ObjectModelTest, AnOpenCageIsRefused) {
  ObjectDescription description = describe(test::torus(0.1, 0.02, 60, 24));
  TriangleMesh cage = test::torus(0.1, 0.03, 24, 8);
  cage.triangles = Triangles(cage.triangles.bottomRows(cage.triangles.rows() - 1));
  writeObj(folder_.file("cage.obj"), cage);
  description.cage_mesh = folder_.file("cage.obj");
  const std::string said = complaint([&] { buildObjectModel(description); });
  EXPECT_TRUE(says(said, "cage.obj: the cage must be closed; 3 edges have one triangle"));
}

TEST_F(ObjectModelTest, AMeshThatSticksOutOfItsTetsIsAcceptedAndTheWarningSaysHowFar) {
  const TetTopology box = testing::boxTopology({5, 4, 3}, {0.2, 0.16, 0.12});
  const Eigen::RowVector3d middle(0.1, 0.08, 0.06);
  const Points larger = (1.1 * (box.rest_vertices.rowwise() - middle)).rowwise() + middle;
  ObjectDescription description = describe({larger, box.surface});
  description.tet_mesh = folder_.file("tets.vtu");
  writeVtu(description.tet_mesh, {box.rest_vertices, box.tets});
  const ObjectModel model = buildObjectModel(description);
  EXPECT_EQ(model.volume.tets, box.tets);
  EXPECT_TRUE(says(model.warnings.back(), "lie outside of the tets, by up to 14 mm"));
}

TEST_F(ObjectModelTest, DISABLED_ToyTetsAreAcceptedAndTheWarningSaysHowFarItSticksOut) {
  ObjectDescription description;
  description.visual_mesh = test::sharedData("toys/toy_surface.obj");
  description.tet_mesh = test::sharedData("toys/toy_tets.vtu");
  const ObjectModel model = buildObjectModel(description);
  EXPECT_EQ(model.volume.tets.rows(), 3068);
  EXPECT_TRUE(says(model.warnings.back(), "lie outside of the tets, by up to 11 mm"));
}

TEST_F(ObjectModelTest, AMeasuredStiffnessHasAStandardDeviation) {
  describe(test::torus(0.1, 0.03, 12, 6));
  const ObjectDescription description = loadObjectDescription(
      yaml("object:\n  visual_mesh: visual.obj\n  material: {youngs_modulus_std: 1500}\n"));
  EXPECT_EQ(description.material.youngs_modulus_std_pa, 1500.0);
  EXPECT_TRUE(description.warnings.empty());
}

TEST_F(ObjectModelTest, DescriptionIsReadWithPathsRelativeToItsFile) {
  describe(test::torus(0.1, 0.03, 12, 6));
  const ObjectDescription description = loadObjectDescription(
      yaml("object:\n  visual_mesh: visual.obj\n  unit: inch\n  colour: red\n"
           "  material: {youngs_modulus_pa: 5.0e3, poisson_ratio: 0.4, density_kg_m3: 100, damping: 0.5}\n"
           "  initial_pose: [1, 2, 3, 0, 0, 0.7071, 0.7071]\n"));
  EXPECT_EQ(description.visual_mesh, folder_.file("visual.obj"));
  EXPECT_EQ(description.unit_m, 0.0254);
  EXPECT_EQ(description.material.poisson_ratio, 0.4);
  EXPECT_FALSE(description.material.youngs_modulus_std_pa);
  ASSERT_TRUE(description.initial_pose);
  EXPECT_TRUE(
      (*description.initial_pose * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  ASSERT_EQ(description.warnings.size(), 1U);
  EXPECT_TRUE(says(description.warnings[0], "object.yaml:4: unknown key object/colour"));
}

TEST_F(ObjectModelTest, MaterialsOfRegionsTakeMissingValuesFromTheObject) {
  describe(test::torus(0.1, 0.03, 12, 6));
  const Material material =
      loadObjectDescription(
          yaml("object:\n  visual_mesh: visual.obj\n  unit: mm\n"
               "  material: {poisson_ratio: 0.4, density_kg_m3: 100}\n"
               "  materials:\n    - {min: [-1, -2, -3], max: [1, 2, 3], youngs_modulus_pa: 1.0e6}\n"
               "    - {max: [0, 9, 9], density_kg_m3: 7}\n"))
          .material;
  ASSERT_EQ(material.regions.size(), 2U);
  EXPECT_TRUE(material.regions[0].min.isApprox(Eigen::Vector3d(-0.001, -0.002, -0.003)));
  EXPECT_TRUE(material.regions[0].max.isApprox(Eigen::Vector3d(0.001, 0.002, 0.003)));
  EXPECT_EQ(material.regions[0].youngs_modulus_pa, 1e6);
  EXPECT_EQ(material.regions[0].poisson_ratio, 0.4);
  EXPECT_EQ(material.regions[0].density_kg_m3, 100.0);
  EXPECT_EQ(material.regions[1].min, Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(material.regions[1].youngs_modulus_pa, material.youngs_modulus_pa);
  EXPECT_EQ(material.regions[1].density_kg_m3, 7.0);
}

TEST_F(ObjectModelTest, BrokenDescriptionsAreRefusedWithLineKeyValueAndRange) {
  describe(test::torus(0.1, 0.03, 12, 6));
  const std::string begin = "object:\n  visual_mesh: visual.obj\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"object: [\n", ":2: not YAML"},
      {"thing: 1\n", ":1: the key 'object' is missing"},
      {"object: 3\n", ":1: 'object/' must be a map"},
      {"object:\n  unit: m\n", ":2: object/visual_mesh is missing"},
      {"object:\n  visual_mesh: none.obj\n", ":2: object/visual_mesh is 'none.obj'; there is no file"},
      {"object:\n  visual_mesh: /etc/passwd\n",
       ":2: object/visual_mesh is '/etc/passwd': /etc/passwd is outside of the folder"},
      {begin + "  tet_mesh: ../body.vtu\n", ":3: object/tet_mesh is '../body.vtu': "},
      {begin + "  unit: ft\n", ":3: object/unit: unit is 'ft'; allowed: m, cm, mm, inch"},
      {begin + "  material: {poisson_ratio: 0.5}\n",
       ":3: object/material/poisson_ratio is '0.5'; allowed: a number from 0 to 0.495"},
      {begin + "  material:\n    density_kg_m3: heavy\n",
       ":4: object/material/density_kg_m3 is 'heavy'; allowed"},
      {begin + "  material: {youngs_modulus_pa: .nan}\n", ":3: object/material/youngs_modulus_pa"},
      {begin + "  material: {youngs_modulus_std: 0}\n",
       ":3: object/material/youngs_modulus_std is '0'; allowed: a number from 0.001 to 1000000000000"},
      {begin + "  materials: 3\n", ":3: object/materials must be a list of maps"},
      {begin + "  materials: [{density_kg_m3: 0}]\n", ":3: object/materials/0/density_kg_m3 is '0'; allowed"},
      {begin + "  materials: [{min: [0, 0, 1], max: [1, 1, 0]}]\n",
       ":3: object/materials/0: min must not exceed max"},
      {begin + "  initial_pose: [0, 0, 0]\n", ":3: object/initial_pose is '[0, 0, 0]'; allowed: a list of 7"},
      {begin + "  initial_pose: [0, 0, 0, 0, 0, 0, 2]\n", "has length 2; allowed: 0.99 to 1.01"}};
  for (const auto& [text, expected] : cases) {
    const std::string path = yaml(text);
    const std::string said = complaint([&path = path] { loadObjectDescription(path); });
    EXPECT_TRUE(says(said, path + (expected[0] == ':' ? expected : ""))) << text;
    EXPECT_TRUE(says(said, expected)) << text;
  }
  EXPECT_TRUE(says(complaint([&] { loadObjectDescription(folder_.file("none.yaml")); }),
                   "none.yaml: cannot be read"));
}

TEST_F(ObjectModelTest, ShippedSpongeIsThePapersOwn) {
  const ObjectModel model = buildObjectModel(
      loadObjectDescription(std::string(SOFTBODY_SOURCE_DIR) + "/../softbody_bringup/config/sponge.yaml"));
  EXPECT_EQ(model.visual.rest_vertices.rows(), 522);
  EXPECT_EQ(model.visual.triangles.rows(), 1040);
  EXPECT_EQ(model.volume.rest_vertices.rows(), 132);
  EXPECT_EQ(model.volume.tets.rows(), 300);
  EXPECT_EQ(model.volume.surface.rows(), 260);
  EXPECT_NEAR(enclosedVolume(model.volume.rest_vertices, model.volume.surface), 0.2 * 0.1 * 0.04, 1e-12);
  expectSound(model);
  EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
}

}  // namespace
}  // namespace softbody
