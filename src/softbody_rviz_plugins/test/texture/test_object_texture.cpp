#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "texture/object_texture.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class ObjectTexture : public ::testing::Test {
 protected:
  ObjectTexture() {
    std::string name = (fs::temp_directory_path() / "softbody_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ObjectTexture() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  fs::path folder_;
};

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
  try {
    textureImageOf(yaml, FileScope::kOwnFolder);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("gone.mtl"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace softbody
