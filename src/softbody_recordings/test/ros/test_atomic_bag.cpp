#include "softbody_recordings/ros/atomic_bag.h"

#include <std_msgs/String.h>
#include <sys/resource.h>
#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <csignal>
#include <random>

#include "softbody_common/files/input_file.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

class AtomicBagTest : public testing::TestWithParam<rosbag::CompressionType> {
 protected:
  AtomicBagTest() {
    writeBytes(output(), "earlier");
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
  }
  ~AtomicBagTest() override { setrlimit(RLIMIT_FSIZE, &before_); }

  /// What a full disk does: a file cannot grow beyond some bytes.
  void limitFiles(rlim_t bytes) {
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }

  fs::path output() const { return folder_ / "out.bag"; }

  /// Writes two megabytes that cannot be compressed. @return the error; empty: none.
  std::string write() {
    return complaint<std::runtime_error>([this] { writeAll(); });
  }
  void writeAll() {
    AtomicBag bag(output(), GetParam());
    std::mt19937 random(1);
    std_msgs::String noise;
    noise.data.resize(100000);
    for (int k = 0; k < 20; ++k) {
      for (char& byte : noise.data) byte = static_cast<char>(random());
      bag.write("/noise", ros::Time(1 + k), noise);
    }
    bag.finish();
  }

  void expectEarlierOnly() const {
    EXPECT_EQ(fs::file_size(output()), 7u);
    EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(folder_)), fs::directory_iterator()), 1);
  }

  const test::ScratchFolder folder_;
  rlimit before_{};
};

INSTANTIATE_TEST_SUITE_P(Compressions, AtomicBagTest,
                         testing::Values(rosbag::compression::Uncompressed, rosbag::compression::LZ4,
                                         rosbag::compression::BZ2),
                         [](const auto& info) { return "Type" + std::to_string(info.param); });

TEST_P(AtomicBagTest, AFullDiskIsASentenceAndLeavesTheEarlierFile) {
  for (const rlim_t bytes : {0, 1000, 5000, 100000, 900000, 1500000}) {
    limitFiles(bytes);
    EXPECT_EQ(write(), output().string() + ": cannot be written: File too large") << bytes;
    expectEarlierOnly();
  }
}

/// The last bytes are written when the bag is closed.
TEST_P(AtomicBagTest, ADiskThatIsFullAtTheLastBytesIsToo) {
  EXPECT_EQ(write(), "");
  const auto size = static_cast<rlim_t>(fs::file_size(output()));
  writeBytes(output(), "earlier");
  for (const rlim_t missing : {1, 10, 100, 1000}) {
    limitFiles(size - missing);
    EXPECT_EQ(write(), output().string() + ": cannot be written: File too large") << missing;
    expectEarlierOnly();
  }
  limitFiles(size);
  EXPECT_EQ(write(), "");
}

TEST_P(AtomicBagTest, AFileOfSomebodyElseWithASimilarNameStays) {
  const fs::path victim = folder_ / "victim";
  writeBytes(victim, "mine");
  fs::create_symlink(victim, output().string() + ".part");
  EXPECT_EQ(write(), "");
  EXPECT_EQ(readFile(victim), "mine");
  EXPECT_TRUE(fs::is_symlink(output().string() + ".part"));
}

}  // namespace
}  // namespace softbody
