#include "softbody_common/files/obj_materials.h"

#include <test_support/gtest.h>

#include <test_support/scratch_folder.h>
#include "softbody_common/files/staged_output.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

class ObjMaterials : public testing::Test {
 protected:
  ObjMaterials() {
    fs::create_directories(folder_ / "toy/textures");
    write("toy/my skin.png", "");
    write("toy/textures/fur.jpg", "");
    write("secret.png", "");
  }

  void write(const std::string& name, const std::string& text) const { replaceFile(folder_ / name, text); }

  /// The pictures of an OBJ, of two materials.
  MaterialPictures find(const std::string& obj, const std::string& mtl) {
    write("toy/my toy.mtl", mtl);
    warnings_.clear();
    write("toy/toy.obj", obj);
    return picturesOf(fileReferences(folder_ / "toy/toy.obj", {"mtllib"}), {"a", "b"}, folder_ / "toy",
                      &warnings_);
  }

  const ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(ObjMaterials, AreFoundByNamesOfOtherSystems) {
  for (const char* name :
       {"my skin.png", "\"my skin.png\"", "C:\\Users\\me\\my skin.png", "/home/me/my skin.png",
        "..\\toy\\my skin.png", "textures/../my skin.png  # a comment"}) {
    const MaterialPictures found =
        find("mtllib my toy.mtl\n",
             std::string("\xef\xbb\xbfnewmtl a\r\nKd 1 1 1\r\n\tmap_Kd ") + name + "\r\nnewmtl b\r\n");
    ASSERT_EQ(found.files.size(), 1U) << name;
    EXPECT_TRUE(fs::equivalent(found.files[0], folder_ / "toy/my skin.png")) << name;
    EXPECT_EQ(found.index, (std::vector<int>{0, -1})) << name;
    EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  }
  EXPECT_EQ(find("MTLLIB C:\\x\\my toy.mtl", "newmtl a\rnewmtl b\rmap_kd textures\\fur.jpg\r").index,
            (std::vector<int>{-1, 0}));
}

TEST_F(ObjMaterials, OfSeveralFilesInOneLineAreFound) {
  write("toy/a.mtl", "newmtl a\nmap_Kd my skin.png\n");
  write("toy/b.mtl", "newmtl b\nmap_Kd textures/fur.jpg\n");
  EXPECT_EQ(find("mtllib a.mtl b.mtl\n", "").index, (std::vector<int>{0, 1}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ObjMaterials, WithOptionsAreFoundAndSaySo) {
  const MaterialPictures found = find(
      "mtllib my toy.mtl\n", "newmtl a\nmap_Kd -s 2 2.5 -1e0 -clamp on -imfchan r my skin.png\nnewmtl b\n");
  EXPECT_EQ(found.index, (std::vector<int>{0, -1}));
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], "my toy.mtl:2: options of map_Kd"));
}

TEST_F(ObjMaterials, StopAtTheFolder) {
  EXPECT_TRUE(find("mtllib my toy.mtl\n", "newmtl a\nmap_Kd ../secret.png\nnewmtl b\n").files.empty());
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], "outside of the folder"));
}

TEST_F(ObjMaterials, ThatAreMissingGiveOneWarning) {
  const std::string twice = "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd gone.png\n";
  EXPECT_TRUE(find("mtllib my toy.mtl\n", twice).files.empty());
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], "my toy.mtl:2: map_Kd names 'gone.png', but there is no file"));
  find("\nmtllib gone.mtl\n", "");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], "toy.obj:2: mtllib names 'gone.mtl'"));
  find("mtllib my toy.mtl\n", "newmtl a\nmap_Kd my skin.png\n");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(says(warnings_[0], "the material 'b' is in no mtllib file"));
}

TEST_F(ObjMaterials, OfAnObjWithoutMaterialNamesAreForAllFaces) {
  write("toy/toy.obj", "mtllib a.mtl\n");
  write("toy/a.mtl", "newmtl plain\nnewmtl skin\nmap_Kd my skin.png\n");
  const MaterialPictures found =
      picturesOf(fileReferences(folder_ / "toy/toy.obj", {"mtllib"}), {}, "", &warnings_);
  EXPECT_EQ(found.otherwise, 0);
  ASSERT_EQ(found.files.size(), 1U);
}

}  // namespace
}  // namespace softbody
