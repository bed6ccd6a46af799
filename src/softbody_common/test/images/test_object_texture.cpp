#include <test_support/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include <test_support/scratch_folder.h>
#include "softbody_common/images/object_texture.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class ObjectTexture : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// An object whose mesh has the image skin.png with these bytes.
  fs::path objectWith(const std::string& bytes) const {
    write("toy.obj", "mtllib toy.mtl\n");
    write("toy.mtl", "newmtl skin\nmap_Kd skin.png\n");
    write("skin.png", bytes);
    return write("object.yaml", "object: {visual_mesh: toy.obj}\n");
  }

  std::string refusal(const std::string& bytes) const {
    try {
      readObjectTexture(objectWith(bytes), FileScope::kOwnFolder);
      return "taken";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }

  test::ScratchFolder folder_;
};

std::string png(const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST_F(ObjectTexture, isTheFirstImageOfTheMaterials) {
  const fs::path yaml = write("toy/object.yaml", "object: {visual_mesh: meshes/toy.obj}\n");
  write("toy/meshes/toy.obj", "# map_Kd no.png\nmtllib my toy.mtl \r\nv 0 0 0\n");
  write("toy/meshes/my toy.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\nnewmtl b\nmap_Kd other.png\n");
  write("toy/meshes/skin.png", "");
  write("toy/meshes/other.png", "");
  EXPECT_EQ(textureImageOf(yaml, FileScope::kOwnFolder), folder_ / "toy/meshes/skin.png");
}

TEST_F(ObjectTexture, isEmptyWithoutMaterialsOrWithAnotherFormat) {
  write("plain.obj", "v 0 0 0\n");
  write("plain.ply", "ply\n");
  EXPECT_TRUE(
      textureImageOf(write("a.yaml", "object: {visual_mesh: plain.obj}\n"), FileScope::kOwnFolder).empty());
  EXPECT_TRUE(
      textureImageOf(write("b.yaml", "object: {visual_mesh: plain.ply}\n"), FileScope::kOwnFolder).empty());
}

TEST_F(ObjectTexture, stopsAtTheFolderOfTheObject) {
  const fs::path yaml = write("toy/object.yaml", "object: {visual_mesh: toy.obj}\n");
  write("toy/toy.obj", "mtllib toy.mtl\n");
  write("toy/toy.mtl", "map_Kd ../secret.png\n");
  write("secret.png", "");
  EXPECT_THROW(textureImageOf(yaml, FileScope::kOwnFolder), std::invalid_argument);
  EXPECT_EQ(fs::weakly_canonical(textureImageOf(yaml, FileScope::kAnywhere)), folder_ / "secret.png");
}

TEST_F(ObjectTexture, saysWhichFileIsMissing) {
  const fs::path yaml = write("object.yaml", "object: {visual_mesh: toy.obj}\n");
  write("toy.obj", "mtllib gone.mtl\n");
  EXPECT_TRUE(says(complaint([&] { textureImageOf(yaml, FileScope::kOwnFolder); }), "gone.mtl"));
}

TEST_F(ObjectTexture, readsColorAndGrey) {
  const cv::Vec3b color(10, 200, 90);
  EXPECT_EQ(readObjectTexture(objectWith(png(cv::Mat3b(3, 5, color))), FileScope::kOwnFolder)(2, 4), color);
  const cv::Mat3b grey = readObjectTexture(objectWith(png(cv::Mat1w(3, 5, 0x8080))), FileScope::kOwnFolder);
  EXPECT_EQ(grey(0, 0), cv::Vec3b::all(0x80));
  EXPECT_EQ(grey.size(), cv::Size(5, 3));
}

TEST_F(ObjectTexture, refusesWhatIsNoUsableImage) {
  const std::string good = png(cv::Mat3b(64, 64, cv::Vec3b(1, 2, 3)));
  std::string huge = good;
  huge[17] = huge[18] = '\x7f';  // the width
  struct Case {
    std::string bytes, said;
  };
  for (const Case& c : {Case{"", "no whole PNG or JPEG"}, Case{"BM0000", "no whole PNG or JPEG"},
                        Case{good.substr(0, 60), "damaged"}, Case{huge, "make the image smaller"}}) {
    EXPECT_TRUE(says(refusal(c.bytes), c.said));
    EXPECT_TRUE(says(refusal(c.bytes), "skin.png"));
  }
}

TEST_F(ObjectTexture, refusesSeveralImages) {
  objectWith(png(cv::Mat3b(2, 2)));
  write("toy.mtl", "newmtl a\nmap_Kd skin.png\nnewmtl b\nmap_Kd more.png\n");
  write("more.png", png(cv::Mat3b(2, 2)));
  EXPECT_THROW(readObjectTexture(folder_ / "object.yaml", FileScope::kOwnFolder), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
