#include "io/stl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "io/polygon_soup.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr float kMostReach =
    1000.0f;  // bytes that are no numbers have any exponent: nearly all are far beyond

std::uint32_t facetCount(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof(count), sizeof(count));
  return count;
}

/// A binary file may begin with "solid", too. Its facets hold zero bytes, which no text has but UTF-16.
bool isAscii(const std::string& bytes) {
  if (bytes.compare(0, 2, "\xff\xfe") == 0 || bytes.compare(0, 2, "\xfe\xff") == 0) return true;
  const std::string head = lowerCase(bytes.substr(0, 1000));  // some programs leave out "solid"
  if (head.find("solid") == std::string::npos && head.find("facet") == std::string::npos) return false;
  return bytes.size() < kHeaderBytes || bytes.find_last_not_of('\0') < bytes.find('\0', kHeaderBytes);
}

/// The last corners, which are those of one facet, become a face.
void endFacet(PolygonSoup* soup, std::size_t first, int place) {
  std::vector<Corner> corners;
  for (std::size_t v = first; v < soup->vertices.size(); ++v) corners.push_back({static_cast<int>(v), -1});
  soup->addFace(corners, -1, place);
}

/// Three corners, each x, y and z.
std::array<float, 9> cornersOf(const std::string& bytes, std::size_t facet) {
  std::array<float, 9> numbers{};
  constexpr std::size_t kNormalBytes = 12;
  std::memcpy(numbers.data(), bytes.data() + kHeaderBytes + facet * kFacetBytes + kNormalBytes,
              sizeof(numbers));
  return numbers;
}

/// The largest size of a coordinate of some facets; infinite if one is not finite.
float reach(const std::string& bytes, std::size_t begin, std::size_t end) {
  float largest = 0.0f;
  for (std::size_t f = begin; f < end; ++f) {
    for (const float x : cornersOf(bytes, f))
      largest = std::max(largest, std::isfinite(x) ? std::abs(x) : std::numeric_limits<float>::infinity());
  }
  return largest;
}

/// Whole facets after the announced ones count, if they look like some: programs write no count, or a wrong
/// one, or something else at the end.
std::size_t presentFacets(const std::string& path, const std::string& bytes, Warnings* warnings) {
  if (bytes.size() < kHeaderBytes) {
    throw std::invalid_argument(fmt::format("{}: {} bytes are too few for an STL file", path, bytes.size()));
  }
  const std::size_t announced = facetCount(bytes), present = (bytes.size() - kHeaderBytes) / kFacetBytes;
  const bool is_whole = (bytes.size() - kHeaderBytes) % kFacetBytes == 0;
  if (announced == present) return present;
  if (announced > present && (present == 0 || !is_whole)) {
    throw std::invalid_argument(
        fmt::format("{}: announces {} facets, but ends after {}", path, announced, present));
  }
  const bool are_facets = announced == 0 || announced > present ||
                          reach(bytes, announced, present) < kMostReach * reach(bytes, 0, announced);
  if (!is_whole || !are_facets) return announced;
  warnings->push_back(
      fmt::format("{}: announces {} facets; all of its {} were read", path, announced, present));
  return present;
}

SurfaceFile readBinary(const std::string& path, const std::string& bytes, Warnings* warnings) {
  const std::size_t count = presentFacets(path, bytes, warnings);
  PolygonSoup soup;
  for (std::size_t f = 0; f < count; ++f) {
    const std::array<float, 9> numbers = cornersOf(bytes, f);
    for (auto corner = numbers.begin(); corner != numbers.end(); corner += 3) {
      const Eigen::RowVector3d position(corner[0], corner[1], corner[2]);
      std::string message;
      if (!position.allFinite())
        message = fmt::format("{}: facet {}: a coordinate is not a finite number", path, f);
      soup.addVertex(position, message);
    }
    endFacet(&soup, 3 * f, static_cast<int>(f));
  }
  return triangulated(soup, path, ": facet ", warnings);
}

SurfaceFile readAscii(const std::string& path, Warnings* warnings) {
  TextReader reader(path);
  PolygonSoup soup;
  std::size_t first = 0;  // vertex of the facet
  std::string last;
  while (reader.next()) {
    const std::string keyword = reader.keyword();
    if (keyword == "vertex") soup.addVertex(reader, 1);
    if (keyword == "endfacet") {
      if (soup.vertices.size() < first + 3) reader.fail("a facet without three vertices");
      endFacet(&soup, first, reader.line());
      first = soup.vertices.size();
    }
    last = keyword;
  }
  if (soup.vertices.size() > first || last.find("end") != 0) reader.fail("the file ends within a facet");
  if (last == "endfacet")
    warnings->push_back(path + ": the file ends without endsolid; check whether a part is missing");
  return triangulated(soup, path, ":", warnings);
}

}  // namespace

SurfaceFile readStl(const std::string& path, Warnings* warnings) {
  const std::string bytes = readFile(path);
  const bool is_whole =
      bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kFacetBytes * facetCount(bytes);
  return is_whole || !isAscii(bytes) ? readBinary(path, bytes, warnings) : readAscii(path, warnings);
}

}  // namespace softbody
