#include "io/stl_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "io/stack_rows.h"
#include "io/text_reader.h"
#include "softbody_common/files/input_file.h"

namespace softbody {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;

/// Every facet has its own three vertices; welding joins them.
SurfaceFile fromCorners(const std::vector<Eigen::RowVector3d>& corners) {
  SurfaceFile file;
  file.mesh.vertices = stackRows<Points>(corners);
  file.mesh.triangles.resize(static_cast<Eigen::Index>(corners.size() / 3), 3);
  for (Eigen::Index f = 0; f < file.mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) file.mesh.triangles(f, k) = static_cast<int>(3 * f) + k;
  }
  return file;
}

std::uint32_t facetCount(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof(count), sizeof(count));
  return count;
}

/// A file may start with "solid" and be binary: some programs write it into binary headers.
bool isBinary(const std::string& bytes) {
  if (bytes.compare(0, 5, "solid") != 0) return true;
  if (bytes.size() < kHeaderBytes) return false;
  return bytes.size() == kHeaderBytes + kFacetBytes * facetCount(bytes) ||
         bytes.find("facet") == std::string::npos;
}

SurfaceFile readBinary(const std::string& path, const std::string& bytes) {
  if (bytes.size() < kHeaderBytes) {
    throw std::invalid_argument(fmt::format("{}: {} bytes are too few for an STL file", path, bytes.size()));
  }
  const std::uint32_t count = facetCount(bytes);
  const std::size_t present = (bytes.size() - kHeaderBytes) / kFacetBytes;
  if (present < count) {
    throw std::invalid_argument(
        fmt::format("{}: announces {} facets, but ends after {}", path, count, present));
  }
  std::vector<Eigen::RowVector3d> corners;
  for (std::size_t f = 0; f < count; ++f) {
    float numbers[12];  // the normal, then three corners
    std::memcpy(numbers, bytes.data() + kHeaderBytes + f * kFacetBytes, sizeof(numbers));
    for (const float* corner = numbers + 3; corner != std::end(numbers); corner += 3) {
      corners.emplace_back(corner[0], corner[1], corner[2]);
      if (!corners.back().allFinite()) {
        throw std::invalid_argument(
            fmt::format("{}: facet {}: a coordinate is not a finite number", path, f));
      }
    }
  }
  return fromCorners(corners);
}

SurfaceFile readAscii(const std::string& path) {
  TextReader reader(path);
  std::vector<Eigen::RowVector3d> corners;
  bool ended = false;
  while (reader.next()) {
    if (reader.keyword() == "vertex") corners.push_back(reader.point(1));
    if (reader.keyword() == "endfacet" && corners.size() % 3 != 0)
      reader.fail("a facet without three vertices");
    ended = reader.keyword() == "endsolid";
  }
  if (!ended) reader.fail("the file ends without endsolid");
  if (corners.size() % 3 != 0) reader.fail("the last facet does not have three vertices");
  return fromCorners(corners);
}

}  // namespace

SurfaceFile readStl(const std::string& path) {
  const std::string bytes = readFile(path);
  return isBinary(bytes) ? readBinary(path, bytes) : readAscii(path);
}

}  // namespace softbody
