#include "softbody_common/files/staged_output.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <test_support/gtest.h>

#include <csignal>
#include <fstream>

#include <test_support/scratch_folder.h>
#include "softbody_common/files/input_file.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;
using test::filesIn;
using test::ScratchFolder;

/// What a full disk does: a file cannot grow beyond a few bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(StagedFile, HasItsNameOnlyWhenItIsComplete) {
  const ScratchFolder folder;
  replaceFile(folder / "a.txt", "earlier");
  {
    const StagedFile abandoned(folder / "a.txt");
    writeBytes(abandoned.path(), "incomplete");
    EXPECT_EQ(abandoned.path().extension(), ".txt");
    EXPECT_EQ(readFile(folder / "a.txt"), "earlier");
  }
  EXPECT_EQ(readFile(folder / "a.txt"), "earlier");
  replaceFile(folder / "a.txt", "new");
  EXPECT_EQ(readFile(folder / "a.txt"), "new");
  EXPECT_EQ(filesIn(folder), std::set<std::string>{"a.txt"});
}

TEST(StagedFile, NeverTakesANameThatSomebodyHas) {
  const ScratchFolder folder;
  const StagedFile first(folder / "a.bag"), second(folder / "a.bag");
  EXPECT_NE(first.path(), second.path());
  replaceFile(folder / "a.bag.part", "mine");
  replaceFile(folder / "a.bag", "new");
  EXPECT_EQ(readFile(folder / "a.bag.part"), "mine");
}

TEST(StagedFile, ReplacesOnlyRegularFiles) {
  const ScratchFolder folder;
  replaceFile(folder / "mine", "mine");
  fs::create_symlink(folder / "mine", folder / "link");
  fs::create_directory(folder / "folder");
  mkfifo((folder / "pipe").c_str(), 0600);
  const std::set<std::string> before = filesIn(folder);
  for (const char* name : {"link", "folder", "pipe"})
    EXPECT_THROW(replaceFile(folder / name, "x"), std::runtime_error) << name;
  EXPECT_THROW(replaceFile("/dev/null", "x"), std::runtime_error);
  EXPECT_THROW(replaceFile(folder / "nowhere/a", "x"), std::runtime_error);
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readFile(folder / "mine"), "mine");
  EXPECT_EQ(filesIn(folder), before);
}

TEST(StagedFile, AFullDiskLeavesTheEarlierFileAndNothingElse) {
  const ScratchFolder folder;
  replaceFile(folder / "a", "earlier");
  const FullDisk disk(10);
  EXPECT_TRUE(says(complaint<std::runtime_error>([&] { replaceFile(folder / "a", std::string(100, 'x')); }),
                   "cannot be written: File too large"));
  EXPECT_EQ(readFile(folder / "a"), "earlier");
  EXPECT_EQ(filesIn(folder), std::set<std::string>{"a"});
}

TEST(StagedFile, ASignalRemovesItAndEndsTheProcess) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const fs::path folder = fs::path(testing::TempDir()) / "staged_output_signal";
  fs::create_directories(folder);
  EXPECT_EXIT(
      {
        const StagedFile file(folder / "a.bag");
        removeStagedFilesOnSignal();
        std::raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove(folder);
}

TEST(StagedFolder, ReplacesAFolderAsAWhole) {
  const ScratchFolder folder;
  for (const char* content : {"first", "second"}) {
    StagedFolder staged(folder / "report/");
    writeBytes(staged.path() / content, content);
    staged.replaceTarget();
  }
  { const StagedFolder abandoned(folder / "report"); }
  EXPECT_EQ(filesIn(folder), std::set<std::string>{"report"});
  EXPECT_EQ(filesIn(folder / "report"), std::set<std::string>{"second"});
}

}  // namespace
}  // namespace softbody
