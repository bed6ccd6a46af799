#include <test_support/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cage/volume_maker.h"
#include "fixtures/object_model_test.h"
#include "softbody_common/files/input_file.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/report/model_folder.h"

namespace softbody {
namespace {

using test::expectSound;
using test::ObjectModelTest;
using test::stretched;

TEST_F(ObjectModelTest, PreparedFolderGivesTheSameModel) {
  const ObjectDescription description = describe(stretched(test::block(), 1000, 1000, 1000));
  std::ostringstream progress;
  prepareModel({description.visual_mesh, "mm", 0.0, {}}, folder_.file("out"), {}, progress);
  const ObjectModel prepared = buildObjectModel(loadObjectDescription(folder_.file("out/object.yaml")));
  expectSound(prepared);
  EXPECT_TRUE(prepared.warnings.empty()) << prepared.warnings.front();
  EXPECT_GT(std::filesystem::file_size(folder_.file("out/report/models.png")), 1000U);
  ObjectDescription scaled = description;
  scaled.unit_m = 0.001;
  EXPECT_EQ(prepared.volume.rest_vertices, buildObjectModel(scaled).volume.rest_vertices);
}

/// The length of the real body replaces the unit, whatever it is.
TEST_F(ObjectModelTest, TheLengthOrTheScaleReplacesTheUnit) {
  const ObjectDescription description = describe(stretched(test::block(), 37, 37, 37));
  std::ostringstream output;
  const auto longestSide = [&](const ModelSource& source) {
    prepareModel(source, folder_.file("out"), {}, output);
    const Points rest =
        buildObjectModel(loadObjectDescription(folder_.file("out/object.yaml"))).visual.rest_vertices;
    return (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff();
  };
  EXPECT_NEAR(longestSide({description.visual_mesh, "m", 0.0, {0.0, 0.2, "", 0}}), 0.2, 1e-6);
  EXPECT_NEAR(longestSide({description.visual_mesh, "m", 0.01, {}}), 37 * 0.2 * 0.01, 1e-4);
  EXPECT_TRUE(says(output.str(), "**Verdict: good.**"));
}

TEST_F(ObjectModelTest, ThePictureOfTheMeshIsKept) {
  const TriangleMesh mesh = test::block();
  const auto prepare = [&](const std::string& materials) {
    folder_.write("skin.mtl", materials);
    writeObj(folder_.file("skinned.obj"), mesh, {Points::Random(3 * mesh.triangles.rows(), 3), "skin.mtl"});
    std::ostringstream output;
    prepareModel({folder_.file("skinned.obj")}, folder_.file("out"), {}, output);
    return output.str();
  };
  cv::imwrite(folder_.file("my skin.png"), cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3)));
  cv::imwrite(folder_.file("skin.bmp"), cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3)));
  EXPECT_FALSE(says(prepare("newmtl body\nmap_Kd C:\\Users\\me\\my skin.png\n"), "picture"));
  EXPECT_EQ(readFile(folder_.file("out/visual.png")), readFile(folder_.file("my skin.png")));
  Warnings warnings;
  const SurfaceFile visual = readSurfaceFile(folder_.file("out/visual.obj"), &warnings);
  const SurfacePictures pictures = surfacePictures(visual, FileScope::kOwnFolder, &warnings);
  ASSERT_EQ(pictures.files, std::vector<std::string>{folder_.file("out/visual.png")});
  EXPECT_EQ(pictures.picture, std::vector<int>(static_cast<std::size_t>(mesh.triangles.rows()), 0));
  EXPECT_TRUE(warnings.empty());

  prepare("newmtl body\nmap_Kd -s 1 1 1 skin.bmp\n");
  EXPECT_EQ(cv::imread(folder_.file("out/visual.png"))(cv::Rect(0, 0, 1, 1)).data[0], 1);
  EXPECT_TRUE(
      says(prepare("newmtl body\nmap_Kd gone.png\n"), "map_Kd names 'gone.png', but there is no file"));
  EXPECT_FALSE(says(readFile(folder_.file("out/visual.obj")), "mtllib"));
}

TEST_F(ObjectModelTest, TheColoursOfTheVerticesAreKept) {
  const TriangleMesh mesh = test::block();
  VertexColors colors;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    colors.push_back({static_cast<std::uint8_t>(v % 256), 90, static_cast<std::uint8_t>(255 - v % 256)});
  writeObj(folder_.file("colored.obj"), mesh, {{}, "", colors});
  std::ostringstream output;
  prepareModel({folder_.file("colored.obj")}, folder_.file("out"), {}, output);
  EXPECT_EQ(readVertexColors(folder_.file("out/visual.obj")), colors);
}

TEST_F(ObjectModelTest, ARefusedMeshLeavesTheFolderAsItWas) {
  std::filesystem::create_directories(folder_.file("out"));
  folder_.write("out/object.yaml", "mine");
  folder_.write("bad.obj", "v 0 0 0\nf 1 1 1\n");
  std::ostringstream progress;
  EXPECT_NE(complaint<std::exception>([&] {
              prepareModel({folder_.file("bad.obj"), "m", 0.0, {}}, folder_.file("out"), {}, progress);
            }),
            "");
  EXPECT_EQ(readFile(folder_.file("out/object.yaml")), "mine");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.file("."))) {
    EXPECT_FALSE(says(entry.path().string(), ".part")) << entry.path();
  }
}

TEST_F(ObjectModelTest, AFolderIsPreparedAgainButFilesOfTheUserStay) {
  const ObjectDescription description = describe(test::block());
  std::ostringstream progress;
  const auto prepare = [&](const std::string& name) {
    return complaint<std::exception>([&] {
      prepareModel({description.visual_mesh, "m", 0.0, {}}, folder_.file(name), {}, progress);
    });
  };
  std::filesystem::create_directories(folder_.file("theirs"));
  folder_.write("theirs/cage.obj", "mine");
  EXPECT_TRUE(says(prepare("theirs"), "theirs/cage.obj was not made by prepare_model"));
  EXPECT_EQ(readFile(folder_.file("theirs/cage.obj")), "mine");
  EXPECT_EQ(prepare("out"), "");
  folder_.write("out/notes.txt", "mine");
  EXPECT_EQ(prepare("out"), "");
  EXPECT_EQ(readFile(folder_.file("out/notes.txt")), "mine");
  std::filesystem::remove(folder_.file("out/tets.vtu"));
  std::filesystem::create_directories(folder_.file("out/tets.vtu"));
  folder_.write("out/visual.obj", "mine");
  EXPECT_TRUE(says(prepare("out"), "out/tets.vtu was not made by prepare_model"));
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
  TriangleMesh triangle{Points(3, 3), Triangles(1, 3)};
  triangle.vertices << 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0;
  triangle.triangles << 0, 1, 2;
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
  for (const TriangleMesh& mesh : {triangle, flatSheet(8, 0.2), two_sided}) {
    describe(mesh);
    const ModelSource sheet{folder_.file("visual.obj"), "m", 0.0, {0.01, 0.0, "", 0}};
    prepareModel(sheet, folder_.file("sheet"), {}, progress);
    const ObjectModel model = buildObjectModel(loadObjectDescription(folder_.file("sheet/object.yaml")));
    expectSound(model);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    const Points& visual = model.visual.rest_vertices;
    EXPECT_NEAR(visual.col(2).maxCoeff() - visual.col(2).minCoeff(), 0.01, 1e-12);
    EXPECT_NEAR(enclosedVolume(visual, model.visual.triangles), 0.01 * std::min(areaOf(mesh), 0.04), 1e-9);
  }
}

TEST_F(ObjectModelTest, AClosedBodyGetsNoThickness) {
  describe(test::block());
  std::ostringstream progress;
  const std::string said = complaint([&] {
    prepareModel({folder_.file("visual.obj"), "m", 0.0, {0.01, 0.0, "", 0}}, folder_.file("out"), {},
                 progress);
  });
  EXPECT_TRUE(says(said, "visual.obj: has no open edges"));
}

/// At any time before the files have their names.
TEST_F(ObjectModelTest, WorkThatIsEndedLeavesTheFolderAsItWas) {
  struct Ended {};
  describe(test::block());
  std::ostringstream output;
  std::vector<double> shares;
  VolumeSettings settings;
  settings.progress = [&](double share) { shares.push_back(share); };
  prepareModel({folder_.file("visual.obj")}, folder_.file("whole"), settings, output);
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  shares.pop_back();
  for (const double end : shares) {
    settings.progress = [end](double share) {
      if (share >= end) throw Ended();
    };
    EXPECT_THROW(prepareModel({folder_.file("visual.obj")}, folder_.file("ended"), settings, output), Ended);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("ended"))) << end;
  }
}

}  // namespace
}  // namespace softbody
