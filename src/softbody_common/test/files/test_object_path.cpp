#include <test_support/gtest.h>

#include <fstream>

#include <test_support/scratch_folder.h>
#include "softbody_common/files/object_path.h"

namespace softbody {
namespace {

class ObjectPath : public testing::Test {
 protected:
  std::string write(const std::string& name) {
    const auto path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << "text";
    return path.string();
  }
  static std::string complaint(const std::string& given) {
    try {
      return "taken: " + objectYamlAt(given);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  }
  test::ScratchFolder folder_;
};

TEST_F(ObjectPath, AFolderMeansItsObjectYaml) {
  const std::string yaml = write("sponge/object.yaml");
  EXPECT_EQ(objectYamlAt((folder_ / "sponge").string()), yaml);
  EXPECT_EQ(objectYamlAt(yaml), yaml);
  const std::string other = write("my_object.yaml");
  EXPECT_EQ(objectYamlAt(other), other);
}

TEST_F(ObjectPath, AMeshIsRefusedWithWhatToGiveInstead) {
  for (const char* name : {"toy.obj", "TOY.STL", "toy.ply", "tets.vtu"}) {
    const std::string mesh = write(name), said = complaint(mesh);
    EXPECT_EQ(said.rfind(mesh, 0), 0U) << said;
    EXPECT_TRUE(says(said, "prepare_model " + mesh));
  }
  const std::string yaml = write("prepared/object.yaml");
  const std::string said = complaint(write("prepared/visual.obj"));
  EXPECT_TRUE(says(said, "give " + yaml));
}

TEST_F(ObjectPath, AFolderWithoutAnObjectIsRefused) {
  const std::string folder = (folder_ / "").string();
  EXPECT_TRUE(says(complaint(folder), "prepare_model"));
}

TEST_F(ObjectPath, AFileThatIsMissingIsLeftToItsReader) {
  EXPECT_EQ(objectYamlAt("/nowhere/object.yaml"), "/nowhere/object.yaml");
}

}  // namespace
}  // namespace softbody
