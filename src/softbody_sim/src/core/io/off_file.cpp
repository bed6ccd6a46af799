#include "io/off_file.h"

#include <fmt/format.h>

#include "io/polygon_soup.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

/// Whether vertices have texture coordinates. @throw std::invalid_argument for variants of other contents.
bool checkWord(const TextReader& reader) {
  const std::string word(reader.fields().front());
  const std::string prefix = word.substr(0, word.size() - std::min<std::size_t>(word.size(), 3));
  if (lowerCase(word.substr(prefix.size())) != "off") reader.fail(fmt::format("'{}' instead of OFF", word));
  if (prefix.find_first_of("4n") != std::string::npos)
    reader.fail(
        fmt::format("{} has vertices of another dimension; save as OFF with three coordinates", word));
  if (prefix.find_first_not_of("STCNstc") != std::string::npos)
    reader.fail(fmt::format("'{}' instead of OFF", word));
  if (reader.fields().size() > 1 && lowerCase(reader.fields()[1]) == "binary")
    reader.fail("binary OFF is not supported; save as ascii");
  return lowerCase(prefix).find("st") == 0;
}

/// Colours follow the corners.
void readFace(const TextReader& reader, PolygonSoup* soup) {
  std::vector<Corner> corners;
  const int count = reader.integer(0);
  for (int k = 1; k <= count; ++k) {
    const int vertex = reader.integer(static_cast<std::size_t>(k));
    corners.push_back({vertex, vertex});
  }
  soup->addFace(corners, -1, reader.line());
}

}  // namespace

SurfaceFile readOff(const std::string& path, Warnings* warnings) {
  TextReader reader(path);
  reader.require("the word OFF");
  std::size_t first = 0;  // the word may be missing, and the counts may follow it on its line
  bool has_texture = false;
  if (std::isdigit(static_cast<unsigned char>(reader.fields().front().front())) == 0 ||
      lowerCase(reader.fields().front()).find("off") != std::string::npos) {
    has_texture = checkWord(reader);
    first = reader.fields().size() > 1 ? 1 : 0;
    if (first == 0) reader.require("the counts of vertices and faces");
  }
  const int vertex_count = reader.count(first), face_count = reader.count(first + 1);
  PolygonSoup soup;
  for (int v = 0; v < vertex_count; ++v) {
    reader.require(fmt::format("vertex {} of {}", v + 1, vertex_count));
    soup.addVertex(reader, 0);
    const std::size_t fields = reader.fields().size();  // texture coordinates come after normal and colour
    if (has_texture)
      soup.texture.emplace_back(parseNumber(reader.fields()[fields - 2]),
                                parseNumber(reader.fields()[fields - 1]), 0.0);
  }
  for (int f = 0; f < face_count; ++f) {
    reader.require(fmt::format("face {} of {}", f + 1, face_count));
    readFace(reader, &soup);
  }
  return triangulated(soup, path, ":", warnings);
}

}  // namespace softbody
