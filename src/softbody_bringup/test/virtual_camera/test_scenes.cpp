#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "softbody_bringup/virtual_camera/camera_setup.h"
#include "softbody_bringup/virtual_camera/obj_file.h"
#include "softbody_common/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

TriangleMesh spongeMesh() { return readObj(std::string(CONFIG_DIR) + "/sponge.obj"); }

TEST(Scenes, BendIsRigidAtTheStartAndKeepsVolume) {
  const TriangleMesh sponge = spongeMesh();
  ASSERT_EQ(sponge.vertices.rows(), 522);
  ASSERT_EQ(sponge.triangles.rows(), 1040);
  const Scene scene = makeScene("bend", sponge, 1);
  const SceneState start = scene.state(0.0);
  for (Eigen::Index i = 0; i < sponge.vertices.rows(); ++i) {
    const Eigen::Vector3d expected = start.T_camera_body * Eigen::Vector3d(sponge.vertices.row(i));
    EXPECT_LT((start.vertices[0].row(i).transpose() - expected).norm(), 1e-12);
  }
  for (double t = 0.0; t < 5.0; t += 0.1) {
    const double volume = enclosedVolume(scene.state(t).vertices[0], sponge.triangles);
    EXPECT_NEAR(volume, 800e-6, 2e-6) << "at " << t;
  }
}

TEST(Scenes, BendMovesWithoutJumps) {
  const Scene scene = makeScene("bend", spongeMesh(), 1);
  Points last = scene.state(0.0).vertices[0];
  for (double t = 0.001; t < 10.0; t += 0.001) {
    const Points now = scene.state(t).vertices[0];
    ASSERT_LT((now - last).rowwise().norm().maxCoeff(), 0.15e-3) << "at " << t;
    last = now;
  }
}

TEST(Scenes, TheExamplesInitialPoseIsRoughlyWhereTheBodyBegins) {
  const auto p = YAML::LoadFile(std::string(CONFIG_DIR) + "/sponge.yaml")["object"]["initial_pose"]
                     .as<std::vector<double>>();
  ASSERT_EQ(p.size(), 7u);
  const Eigen::Isometry3d rough =
      Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(p[6], p[3], p[4], p[5]).normalized();
  for (const std::string& name : sceneNames()) {
    const Eigen::Isometry3d error =
        makeScene(name, spongeMesh(), 1).state(0.0).T_camera_body.inverse() * rough;
    EXPECT_LT(error.translation().norm(), 0.02) << name;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.14) << name;
  }
}

TEST(Scenes, UnknownNamesAreAnsweredWithTheKnownOnes) {
  try {
    makeScene("stretch", spongeMesh(), 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("bend"), std::string::npos);
  }
  NoiseOptions noise;
  EXPECT_THROW(switchOff("wind", &noise), std::invalid_argument);
  for (const std::string& part : noiseParts()) switchOff(part, &noise);
  EXPECT_FALSE(noise.color.enabled || noise.depth.disparity_noise || noise.depth.quantization ||
               noise.depth.edge_dropouts || noise.depth.holes);
}

TEST(ReadObj, SaysWhichLineIsWrong) {
  const std::string path = testing::TempDir() + "wrong.obj";
  for (const char* line : {"v 0 0 x", "f 1 2 9", "f 1 2", "f a b c"}) {
    std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2 3/3\n" << line << "\n";
    try {
      readObj(path);
      FAIL() << line;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("line 5"), std::string::npos) << error.what();
    }
  }
  std::remove(path.c_str());
  EXPECT_THROW(readObj(path), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::virtual_camera
