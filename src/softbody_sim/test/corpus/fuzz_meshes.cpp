#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "corpus/broken_meshes.h"

/// Reads mutated mesh files of every format with little memory. A file that is neither read nor rejected with
/// a message is kept and named; exit code 1. A crash leaves the last file.
int main(int argc, char** argv) {
  using namespace softbody;
  if (argc < 3) {
    std::cerr << "usage: fuzz_meshes FOLDER MUTATIONS [SEED]\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const rlimit memory{rlim_t{1} << 30, rlim_t{1} << 30};
  setrlimit(RLIMIT_AS, &memory);
  const int mutations = std::atoi(argv[2]);
  int read = 0, refused = 0;
  for (const test::BrokenFile& sound : test::soundFiles()) {
    std::mt19937 random(argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1U);
    const std::string path = (folder / sound.name).string();
    for (int k = 0; k < mutations; ++k) {
      std::ofstream(path, std::ios::binary) << test::mutated(sound.bytes, &random);
      try {
        ++(test::readOrRefuse(path).empty() ? read : refused);
      } catch (const std::exception& fault) {
        fmt::print("{}\n", fault.what());
        return 1;
      }
    }
    std::filesystem::remove(path);
  }
  fmt::print("{} mutated files read, {} refused with a sentence\n", read, refused);
  return 0;
}
