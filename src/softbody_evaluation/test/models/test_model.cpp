#include "softbody_evaluation/models/model.h"

#include <test_support/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace softbody::evaluation {
namespace {

class ModelFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string complaint(const std::string& path) const {
    std::vector<std::string> warnings;
    try {
      readModel(path, &warnings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "models";
};

constexpr const char* kScan =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float seen\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 1\n100 0 0 1\n0 100 0 0\n100 100 0 0.5\n3 0 1 2\n3 1 3 2\n";

TEST_F(ModelFiles, AScanSaysWhatWasSeen) {
  std::vector<std::string> warnings;
  const Model model = readModel(write("scan.ply", kScan), &warnings);
  EXPECT_EQ(model.seen, (std::vector<float>{1.0f, 1.0f, 0.0f, 0.5f}));
  EXPECT_TRUE(warnings.empty());
}

TEST_F(ModelFiles, AFolderGivesUnitPictureAndWhatWasSeen) {
  write("object.yaml", "object: {visual_mesh: visual.obj, unit: mm}\n");
  write("visual.obj",
        "mtllib visual.mtl\nusemtl body\nv 0 0 0\nv 100 100 0\nv 0 100 0\nvt 0 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 2/2 3/3\n");
  write("visual.mtl", "newmtl body\nmap_Kd visual.png\n");
  cv::imwrite((folder_ / "visual.png").string(), cv::Mat3b(8, 8, cv::Vec3b(10, 20, 30)));
  std::string scan = kScan;
  for (std::size_t at = scan.find("100 "); at != std::string::npos; at = scan.find("100 ", at))
    scan.replace(at, 4, "0.1 ");
  write("scan.ply", scan);
  std::vector<std::string> warnings;
  const Model model = readModel(folder_.string(), &warnings);
  EXPECT_NEAR(diagonalOf(model.mesh), 0.1 * std::sqrt(2.0), 1e-12);
  ASSERT_EQ(model.seen.size(), 3u);
  EXPECT_NEAR(model.seen[0], 1.0, 1e-6);
  EXPECT_NEAR(model.seen[1], 0.5, 1e-6);
  EXPECT_NEAR(model.seen[2], 0.0, 1e-6);
  EXPECT_TRUE(colorAt(model, 0, {0.2, 0.3, 0.5}).isApprox(Eigen::Vector3d(10, 20, 30)));
}

TEST_F(ModelFiles, BadFilesAreNamed) {
  EXPECT_TRUE(says(complaint("/nowhere/body.obj"), "/nowhere/body.obj: does not exist"));
  EXPECT_TRUE(says(complaint(write("points.obj", "v 0 0 0\nv 1 0 0\n")), "no faces"));
  EXPECT_TRUE(says(complaint(write("point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n")), "one point"));
}

}  // namespace
}  // namespace softbody::evaluation
