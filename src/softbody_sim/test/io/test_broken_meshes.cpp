#include <test_support/gtest.h>

#include "corpus/broken_meshes.h"
#include "corpus/model_corpus.h"
#include "fixtures/model_files.h"

namespace softbody {
namespace {

using test::BrokenFile;
using test::ScratchFolder;

class BrokenMeshes : public testing::TestWithParam<BrokenFile> {};
INSTANTIATE_TEST_SUITE_P(Corpus, BrokenMeshes, testing::ValuesIn(test::brokenFiles()), [](const auto& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST_P(BrokenMeshes, AreRepairedOrRefusedWithTheirSentence) {
  const ScratchFolder folder;
  const std::string path = folder.write(GetParam().name, GetParam().bytes);
  const std::string refusal = test::readOrRefuse(path);
  if (!GetParam().sentence.empty()) {
    EXPECT_TRUE(says(refusal, GetParam().sentence)) << "refusal: '"
                                                    << "'";
    return;
  }
  EXPECT_EQ(refusal, "");
  const test::PreparedModel prepared = test::prepareAndCheck({"", path, false}, folder.file("."));
  EXPECT_TRUE(prepared.faults.empty()) << prepared.faults.front();
}

/// `make fuzz` tries many more.
TEST(MutatedMeshes, AreReadOrRefusedWithASentence) {
  const ScratchFolder folder;
  int refused = 0;
  for (const BrokenFile& sound : test::soundFiles()) {
    std::mt19937 random(2);
    for (int k = 0; k < 100; ++k) {
      const std::string path = folder.write(sound.name, test::mutated(sound.bytes, &random));
      refused += test::readOrRefuse(path).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace softbody
