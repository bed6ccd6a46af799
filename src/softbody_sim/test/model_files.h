#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "softbody_common/types.h"

namespace softbody::test {

/// A folder of its own, gone at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "softbody_model_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

/// ../shared/data beside the repository, or empty.
inline std::string sharedData() {
  std::error_code missing;
  return std::filesystem::canonical(std::filesystem::path(SOFTBODY_SOURCE_DIR) / "../../../shared/data",
                                    missing)
      .string();
}

/// What a call complains about; empty if it does not.
template <typename Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// Closed surface of a torus around z, with 2 n m triangles.
inline TriangleMesh torus(double ring_radius, double tube_radius, int n, int m) {
  TriangleMesh mesh{Points(n * m, 3), Triangles(2 * n * m, 3)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2.0 * M_PI * i / n, v = 2.0 * M_PI * j / m,
                   r = ring_radius + tube_radius * std::cos(v);
      mesh.vertices.row(i * m + j) << r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v);
      const int a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m,
                d = i * m + (j + 1) % m;
      mesh.triangles.row(2 * (i * m + j)) << a, b, c;
      mesh.triangles.row(2 * (i * m + j) + 1) << a, c, d;
    }
  }
  return mesh;
}

}  // namespace softbody::test

#define SKIP_WITHOUT_SHARED_DATA() \
  if (softbody::test::sharedData().empty()) GTEST_SKIP() << "skipped: no ../shared/data"
