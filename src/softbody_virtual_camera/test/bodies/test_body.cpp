#include "softbody_virtual_camera/bodies/body.h"

#include <test_support/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "fixtures/scene_fixtures.h"
#include "softbody_virtual_camera/camera/virtual_camera.h"

namespace softbody::virtual_camera {
namespace {

namespace fs = std::filesystem;

/// A folder of its own with a tetrahedron `body.obj` (of the given text after its vertices), `body.mtl` and
/// `skin.png`.
class BodyFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  void writeObj(const std::string& text) const {
    write("body.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nvt 0 0\nvt 1 0\nvt 0 1\n" + text);
  }

  Body read() const {
    std::vector<std::string> warnings;
    return readBody((folder_ / "body.obj").string(), 1e-3, &warnings);
  }

  /// The only warning.
  std::string warning() const {
    std::vector<std::string> warnings;
    readBody((folder_ / "body.obj").string(), 1e-3, &warnings);
    return warnings.size() == 1 ? warnings.front() : std::to_string(warnings.size()) + " warnings";
  }

  /// What the reader says, or "" if it says nothing.
  std::string complaint() const {
    try {
      read();
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "virtual camera body";
  const std::string faces_ = "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n";
};

TEST_F(BodyFiles, ShowsThePicturesThatTheMaterialsName) {
  cv::Mat3b image(64, 64, cv::Vec3b(0, 0, 255));  // red above, green below; OpenCV's order
  image.rowRange(32, 64).setTo(cv::Vec3b(0, 255, 0));
  cv::imwrite((folder_ / "the skin.png").string(), image);
  write("body.mtl", "newmtl plain\nKd 1 1 1\nnewmtl with skin\nmap_Kd the skin.png  # a comment\n");
  writeObj("mtllib body.mtl\nusemtl with skin\nf 1/1 3/2 2/3\nusemtl plain\n" + faces_.substr(14));
  const Body body = read();
  EXPECT_EQ(body.rest.vertices(1, 0), 0.1);
  ASSERT_EQ(body.skin.picture, (std::vector<int>{0, -1, -1, -1}));
  EXPECT_EQ(body.skin.coordinates.rows(), 12);
  const Eigen::Vector3f low = pictureColor(body.skin, 0, 0, 0.1, 0.1),
                        high = pictureColor(body.skin, 0, 0, 0.1, 0.8);
  EXPECT_LT((low - Eigen::Vector3f(0, 1, 0)).norm(), 1e-6f);  // v points upwards
  EXPECT_LT((high - Eigen::Vector3f(1, 0, 0)).norm(), 1e-6f);
}

TEST_F(BodyFiles, WarnsOfAMissingFileOrMaterialAndWhere) {
  writeObj("mtllib absent.mtl\n" + faces_);
  EXPECT_TRUE(says(warning(), "body.obj:8: mtllib names 'absent.mtl'"));
  write("body.mtl", "newmtl skin\nmap_Kd absent.png\n");
  writeObj("mtllib body.mtl\nusemtl skin\n" + faces_);
  EXPECT_TRUE(says(warning(), "body.mtl:2: map_Kd names 'absent.png'"));
  write("body.mtl", "newmtl other\n");
  EXPECT_TRUE(says(warning(), "the material 'skin'"));
  write("body.mtl", "newmtl skin\nmap_Kd skin.png\n");
  write("skin.png", "no picture");
  EXPECT_TRUE(says(complaint(), "skin.png: is not an image"));
}

/// A bare file name has no folder.
TEST_F(BodyFiles, InTheCurrentFolderAreReadByTheirBareName) {
  cv::imwrite((folder_ / "skin.png").string(), cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3)));
  write("body.mtl", "newmtl skin\nmap_Kd skin.png\n");
  writeObj("mtllib body.mtl\nusemtl skin\n" + faces_);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  std::vector<std::string> warnings;
  const Body body = readBody("body.obj", 1e-3, &warnings);
  fs::current_path(before);
  EXPECT_EQ(body.skin.picture, (std::vector<int>{0, 0, 0, 0}));
  EXPECT_TRUE(warnings.empty());
}

TEST_F(BodyFiles, WantsFacesAndForPicturesTextureCoordinates) {
  writeObj("");
  EXPECT_NE(complaint(), "");
  cv::imwrite((folder_ / "skin.png").string(), cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3)));
  write("body.mtl", "newmtl skin\nmap_Kd skin.png\n");
  writeObj("mtllib body.mtl\nusemtl skin\nf 1 3 2\n");
  EXPECT_TRUE(says(complaint(), "no texture coordinates"));
  writeObj("f 1 2 9\n");
  EXPECT_TRUE(says(complaint(), "body.obj:8"));
}

TEST(PictureColor, IsBilinearAndRepeats) {
  cv::Mat3b image(16, 32);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image(y, x) = cv::Vec3b(static_cast<uchar>(8 * x), static_cast<uchar>(16 * y), 7);
  }
  UvTexture texture{Points(6, 3), {0, 0}, {makePicture(image)}};
  texture.coordinates << 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, -2, 0, 4, -2, 0, 3, -1, 0;
  for (double w1 = 0.05; w1 < 0.5; w1 += 0.037) {
    for (double w2 = 0.05; w2 < 0.5; w2 += 0.041) {
      const Eigen::Vector3f expected(static_cast<float>(8.0 * (32 * w1 - 0.5) / 255.0),
                                     static_cast<float>(16.0 * (16 * (1 - w2) - 0.5) / 255.0), 7.0f / 255.0f);
      for (const int triangle : {0, 1}) {
        EXPECT_LT((pictureColor(texture, triangle, 0, w1, w2) - expected).norm(), 1e-5f) << w1 << ", " << w2;
      }
    }
  }
}

TEST(PictureLevel, HasNoMorePixelsThanTexels) {
  const TriangleMesh mesh = rectangleMesh(0.1, 0.1);
  UvTexture texture{Points(6, 3), {0, 0}, {makePicture(cv::Mat3b(1024, 1024, cv::Vec3b(0, 0, 0)))}};
  texture.coordinates << 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0;
  EXPECT_EQ(pictureLevel(texture, mesh, 0, 0.2 / 1024), 0);
  EXPECT_EQ(pictureLevel(texture, mesh, 0, 0.2 / 256), 2);
  EXPECT_EQ(pictureLevel(texture, mesh, 1, 1.0), 10);
}

TEST(BodyFrame, BodiesOfAnySizeAndAxisLookAlike) {
  // The same sponge in inches, elsewhere, lying along y.
  const Body sponge = shippedBody("sponge");
  Body other = sponge;
  other.rest.vertices.col(0) = 0.5 - 2.54 * sponge.rest.vertices.col(1).array();
  other.rest.vertices.col(1) = 2.54 * sponge.rest.vertices.col(0).array() - 0.2;
  other.rest.vertices.col(2) = 2.54 * sponge.rest.vertices.col(2).array() + 0.1;
  VirtualCamera first(makeScene("bend", sponge, 1), d435(160, 120), noNoise(), 1);
  VirtualCamera second(makeScene("bend", other, 1), d435(160, 120), noNoise(), 1);
  EXPECT_EQ(second.topology(0).rest_vertices, other.rest.vertices);
  for (const double t : {0.0, 1.0, 3.5}) {
    const Capture a = first.capture(0, t), b = second.capture(0, t);
    EXPECT_LT((2.54 * a.truth.vertices - b.truth.vertices).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(cv::norm(a.color, b.color, cv::NORM_L1) / static_cast<double>(a.color.total()), 0.1);
    EXPECT_EQ(a.truth.confidence, b.truth.confidence);
    if (t == 0.0) {
      const Points placed = transformed(b.T_camera_body, other.rest.vertices);
      EXPECT_LT((placed - b.truth.vertices).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(BodyFrame, StandingBodiesLieDown) {
  const Body sponge = shippedBody("sponge");
  Body standing = sponge;
  standing.rest.vertices.col(0) = -sponge.rest.vertices.col(2);
  standing.rest.vertices.col(2) = sponge.rest.vertices.col(0);
  const Points lying = makeScene("still", sponge, 1).state(0.0).vertices.at(0);
  EXPECT_LT((makeScene("still", standing, 1).state(0.0).vertices.at(0) - lying).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BodyFrame, RefusesSizesThatAreAWrongUnit) {
  Body body = shippedBody("sponge");
  body.rest.vertices *= 1000.0;
  EXPECT_THROW(makeScene("bend", body, 1), std::invalid_argument);
  body.rest.vertices *= 1e-5;
  EXPECT_THROW(makeScene("bend", body, 1), std::invalid_argument);
}

}  // namespace
}  // namespace softbody::virtual_camera
