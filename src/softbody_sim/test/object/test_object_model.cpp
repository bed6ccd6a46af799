#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "cage/enclosure.h"
#include "cage/volume_maker.h"
#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "report/model_folder.h"
#include "softbody_common/input_file.h"
#include "softbody_common/staged_output.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"
#include "softbody_sim/object/object_model.h"
#include "surface_mesh/surface_repair.h"

namespace softbody {
namespace {

using test::complaint;
using test::TemporaryFolder;

/// Uses a temporary cache instead of the user's.
class ObjectModelTest : public ::testing::Test {
 protected:
  ObjectModelTest() { setenv("XDG_CACHE_HOME", folder_.file("cache").c_str(), 1); }
  ~ObjectModelTest() override { unsetenv("XDG_CACHE_HOME"); }

  ObjectDescription describe(const TriangleMesh& mesh) const {
    writeObj(folder_.file("visual.obj"), mesh);
    ObjectDescription description;
    description.visual_mesh = folder_.file("visual.obj");
    return description;
  }

  std::string yaml(const std::string& text) const { return folder_.write("object.yaml", text); }

  TemporaryFolder folder_;
};

TriangleMesh stretched(TriangleMesh mesh, double x, double y, double z) {
  mesh.vertices *= Eigen::Vector3d(x, y, z).asDiagonal();
  return mesh;
}

void expectSound(const ObjectModel& model) {
  const TetTopology& volume = model.volume;
  const Eigen::VectorXd volumes = tetVolumes(volume.rest_vertices, volume.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  EXPECT_NEAR(enclosedVolume(volume.rest_vertices, volume.surface), volumes.sum(), 1e-9 * volumes.sum());
  EXPECT_TRUE(examineEdges(volume.surface).closed());
  EXPECT_EQ(examineEdges(volume.surface).inconsistent, 0);
  EXPECT_TRUE(
      pointsOutside(model.visual.rest_vertices, {volume.rest_vertices, volume.tets}, volume.surface).empty());
}

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
  EXPECT_NE(model.warnings[0].find("not closed"), std::string::npos);
}

void expectEqual(const ObjectModel& a, const ObjectModel& b) {
  EXPECT_EQ(a.volume.rest_vertices, b.volume.rest_vertices);
  EXPECT_EQ(a.volume.tets, b.volume.tets);
  EXPECT_EQ(a.warnings, b.warnings);
}

TEST_F(ObjectModelTest, AKeptVolumeEqualsANewOneBitForBit) {
  const ObjectDescription description = describe(test::torus(0.1, 0.03, 60, 24));
  VolumeSettings uncached;
  uncached.use_cache = false;
  const ObjectModel made = buildObjectModel(description, uncached);
  EXPECT_FALSE(std::filesystem::exists(folder_.file("cache")));
  expectEqual(made, buildObjectModel(description));
  EXPECT_FALSE(std::filesystem::is_empty(folder_.file("cache/softbody")));
  expectEqual(made, buildObjectModel(description));
}

/// The only entry of the cache.
class KeptVolume : public ObjectModelTest {
 protected:
  KeptVolume() : made_(buildObjectModel(description_)) {}

  std::filesystem::path entry() const {
    return std::filesystem::directory_iterator(folder_.file("cache/softbody"))->path();
  }
  /// The model is made again, with one warning.
  void expectSkipped() const {
    const ObjectModel again = buildObjectModel(description_);
    EXPECT_EQ(again.volume.rest_vertices, made_.volume.rest_vertices);
    EXPECT_EQ(again.volume.tets, made_.volume.tets);
    ASSERT_EQ(again.warnings.size(), 1U);
    EXPECT_NE(again.warnings[0].find("the cache of prepared models is not used"), std::string::npos)
        << again.warnings[0];
  }

  ObjectDescription description_ = describe(test::torus(0.1, 0.03, 60, 24));
  ObjectModel made_;
};

TEST_F(KeptVolume, IsMadeAgainIfItIsIncomplete) {
  std::filesystem::resize_file(entry(), 1000);
  expectSkipped();
  expectEqual(made_, buildObjectModel(description_));
}

TEST_F(KeptVolume, IsMadeAgainIfItWasChanged) {
  std::string text = readFile(entry());
  const std::size_t digit = text.find("0.1");
  ASSERT_NE(digit, std::string::npos);
  text[digit + 2] = '2';
  writeBytes(entry(), text);
  expectSkipped();
  expectEqual(made_, buildObjectModel(description_));
}

TEST_F(KeptVolume, IsMadeAgainIfItBelongsToOtherInputs) {
  const std::filesystem::path first = entry();
  const std::string text = readFile(first);
  std::filesystem::remove(first);
  description_ = describe(test::torus(0.1, 0.02, 60, 24));
  made_ = buildObjectModel(description_);
  writeBytes(entry(), text);
  expectSkipped();
}

TEST_F(KeptVolume, IsNotUsedIfItIsNoFile) {
  const std::filesystem::path path = entry();
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  expectSkipped();
  std::filesystem::remove(path);
  mkfifo(path.c_str(), 0600);
  expectSkipped();
  std::filesystem::remove(path);
  std::filesystem::create_symlink(folder_.file("visual.obj"), path);
  expectSkipped();
  EXPECT_TRUE(std::filesystem::is_symlink(path));
}

TEST_F(ObjectModelTest, AnUnusableCacheIsAWarning) {
  folder_.write("cache", "a file where a folder should be");
  const ObjectModel model = buildObjectModel(describe(test::torus(0.1, 0.03, 60, 24)));
  expectSound(model);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_NE(model.warnings[0].find("the cache of prepared models is not used"), std::string::npos);
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
  EXPECT_NE(said.find("cage.obj: the cage must be closed; 3 edges have one triangle"), std::string::npos)
      << said;
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
  EXPECT_NE(model.warnings.back().find("lie outside of the tets, by up to 14 mm"), std::string::npos)
      << model.warnings.back();
}

TEST_F(ObjectModelTest, DISABLED_ToyTetsAreAcceptedAndTheWarningSaysHowFarItSticksOut) {
  ObjectDescription description;
  description.visual_mesh = test::sharedData("toys/toy_surface.obj");
  description.tet_mesh = test::sharedData("toys/toy_tets.vtu");
  const ObjectModel model = buildObjectModel(description);
  EXPECT_EQ(model.volume.tets.rows(), 3068);
  EXPECT_NE(model.warnings.back().find("lie outside of the tets, by up to 11 mm"), std::string::npos)
      << model.warnings.back();
}

TEST_F(ObjectModelTest, PreparedFolderGivesTheSameModel) {
  const ObjectDescription description = describe(stretched(test::torus(0.1, 0.03, 60, 24), 1000, 1000, 1000));
  std::ostringstream progress;
  prepareModel({description.visual_mesh, "mm"}, folder_.file("out"), {}, progress);
  const ObjectModel prepared = buildObjectModel(loadObjectDescription(folder_.file("out/object.yaml")));
  expectSound(prepared);
  EXPECT_TRUE(prepared.warnings.empty()) << prepared.warnings.front();
  EXPECT_GT(std::filesystem::file_size(folder_.file("out/report/models.png")), 1000U);
  ObjectDescription scaled = description;
  scaled.unit_m = 0.001;
  EXPECT_EQ(prepared.volume.rest_vertices, buildObjectModel(scaled).volume.rest_vertices);
}

TEST_F(ObjectModelTest, ARefusedMeshLeavesTheFolderAsItWas) {
  std::filesystem::create_directories(folder_.file("out"));
  folder_.write("out/object.yaml", "mine");
  folder_.write("bad.obj", "v 0 0 0\nf 1 1 1\n");
  std::ostringstream progress;
  EXPECT_NE(complaint([&] { prepareModel({folder_.file("bad.obj")}, folder_.file("out"), {}, progress); }),
            "");
  EXPECT_EQ(readFile(folder_.file("out/object.yaml")), "mine");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("."))) {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

TEST_F(ObjectModelTest, AFolderIsPreparedAgainButFilesOfTheUserStay) {
  const ObjectDescription description = describe(test::torus(0.1, 0.03, 60, 24));
  std::ostringstream progress;
  const auto prepare = [&](const std::string& name) {
    return complaint([&] { prepareModel({description.visual_mesh}, folder_.file(name), {}, progress); });
  };
  std::filesystem::create_directories(folder_.file("theirs"));
  folder_.write("theirs/cage.obj", "mine");
  EXPECT_NE(prepare("theirs").find("theirs/cage.obj was not made by prepare_model"), std::string::npos);
  EXPECT_EQ(readFile(folder_.file("theirs/cage.obj")), "mine");
  EXPECT_EQ(prepare("out"), "");
  folder_.write("out/notes.txt", "mine");
  EXPECT_EQ(prepare("out"), "");
  EXPECT_EQ(readFile(folder_.file("out/notes.txt")), "mine");
  std::filesystem::remove(folder_.file("out/tets.vtu"));
  std::filesystem::create_directories(folder_.file("out/tets.vtu"));
  folder_.write("out/visual.obj", "mine");
  EXPECT_NE(prepare("out").find("out/tets.vtu was not made by prepare_model"), std::string::npos);
  EXPECT_EQ(readFile(folder_.file("out/visual.obj")), "mine");
}

TriangleMesh flatSheet(int cells, double size) {
  TriangleMesh mesh{Points((cells + 1) * (cells + 1), 3), Triangles(2 * cells * cells, 3)};
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) mesh.vertices.row(i * (cells + 1) + j) << i, j, 0.0;
  mesh.vertices *= size / cells;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const int a = i * (cells + 1) + j, b = a + cells + 1, f = 2 * (i * cells + j);
      mesh.triangles.row(f) << a, b, b + 1;
      mesh.triangles.row(f + 1) << a, b + 1, a + 1;
    }
  }
  return mesh;
}

TEST_F(ObjectModelTest, AMeshWithoutVolumeIsRefusedOrGetsTheStatedThickness) {
  const TriangleMesh triangle{(Points(3, 3) << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0).finished(),
                              (Triangles(1, 3) << 0, 1, 2).finished()};
  TriangleMesh two_sided = flatSheet(8, 0.2);
  two_sided.triangles.conservativeResize(256, 3);
  two_sided.triangles.bottomRows(128) = two_sided.triangles.topRows(128).rowwise().reverse();
  std::ostringstream progress;
  for (const TriangleMesh& mesh : {triangle, flatSheet(8, 0.2), two_sided}) {
    ObjectDescription description = describe(mesh);
    const std::string said = complaint([&] { buildObjectModel(description); });
    EXPECT_TRUE(said.find("visual.obj: encloses no volume") != std::string::npos ||
                said.find("visual.obj: no triangle") != std::string::npos)
        << said;
  }
  for (const TriangleMesh& mesh : {triangle, flatSheet(8, 0.2)}) {
    describe(mesh);
    prepareModel({folder_.file("visual.obj"), "m", 0.01}, folder_.file("sheet"), {}, progress);
    const ObjectModel model = buildObjectModel(loadObjectDescription(folder_.file("sheet/object.yaml")));
    expectSound(model);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    const Points& visual = model.visual.rest_vertices;
    EXPECT_NEAR(visual.col(2).maxCoeff() - visual.col(2).minCoeff(), 0.01, 1e-12);
    EXPECT_NEAR(enclosedVolume(visual, model.visual.triangles), 0.01 * areaOf(mesh), 1e-9);
  }
}

TEST_F(ObjectModelTest, AClosedBodyGetsNoThickness) {
  describe(test::torus(0.1, 0.03, 60, 24));
  std::ostringstream progress;
  const std::string said = complaint([&] {
    prepareModel({folder_.file("visual.obj"), "m", 0.01}, folder_.file("out"), {}, progress);
  });
  EXPECT_NE(said.find("visual.obj: has no open edges"), std::string::npos) << said;
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
  ASSERT_TRUE(description.initial_pose);
  EXPECT_TRUE(
      (*description.initial_pose * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  ASSERT_EQ(description.warnings.size(), 1U);
  EXPECT_NE(description.warnings[0].find("object.yaml:4: unknown key object/colour"), std::string::npos);
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
      {begin + "  initial_pose: [0, 0, 0]\n", ":3: object/initial_pose is '[0, 0, 0]'; allowed: a list of 7"},
      {begin + "  initial_pose: [0, 0, 0, 0, 0, 0, 2]\n", "has length 2; allowed: 0.99 to 1.01"}};
  for (const auto& [text, expected] : cases) {
    const std::string path = yaml(text);
    const std::string said = complaint([&path = path] { loadObjectDescription(path); });
    EXPECT_NE(said.find(path + (expected[0] == ':' ? expected : "")), std::string::npos) << text << "\n"
                                                                                         << said;
    EXPECT_NE(said.find(expected), std::string::npos) << text << "\n" << said;
  }
  EXPECT_NE(
      complaint([&] { loadObjectDescription(folder_.file("none.yaml")); }).find("none.yaml: cannot be read"),
      std::string::npos);
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
