#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz/feeds.h"
#include "softbody_common/files/input_file.h"

namespace softbody::fuzz {
namespace {

class FuzzCorpus : public testing::TestWithParam<Feed> {};
INSTANTIATE_TEST_SUITE_P(Feeds, FuzzCorpus, testing::ValuesIn(feeds()),
                         [](const auto& info) { return info.param.name; });

/// Seeds of `make fuzz`, and files with which it once found a fault. `make fuzz` tries many more.
TEST_P(FuzzCorpus, IsReadOrRefusedWithASentence) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(FUZZ_CORPUS) / GetParam().name)) {
    EXPECT_NO_THROW(GetParam().give(readFile(entry.path()))) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace softbody::fuzz
