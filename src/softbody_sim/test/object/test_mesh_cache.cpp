#include <sys/stat.h>
#include <test_support/gtest.h>

#include "fixtures/object_model_test.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"

namespace softbody {
namespace {

using test::expectSound;
using test::ObjectModelTest;

void expectEqual(const ObjectModel& a, const ObjectModel& b) {
  EXPECT_EQ(a.volume.rest_vertices, b.volume.rest_vertices);
  EXPECT_EQ(a.volume.tets, b.volume.tets);
  EXPECT_EQ(a.warnings, b.warnings);
}

TEST_F(ObjectModelTest, AKeptVolumeEqualsANewOneBitForBit) {
  const ObjectDescription description = describe(test::block());
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
    EXPECT_TRUE(says(again.warnings[0], "the cache of prepared models is not used"));
  }

  ObjectDescription description_ = describe(test::block());
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
  description_ = describe(test::boxMesh({0.2, 0.1, 0.03}));
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
  const ObjectModel model = buildObjectModel(describe(test::block()));
  expectSound(model);
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_TRUE(says(model.warnings[0], "the cache of prepared models is not used"));
}

}  // namespace
}  // namespace softbody
