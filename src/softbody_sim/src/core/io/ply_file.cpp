#include "io/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "io/polygon_soup.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

template <typename T>
double decode(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::copy(bytes, bytes + sizeof(T), ordered);
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

/// A number type of PLY.
struct Type {
  std::size_t bytes;
  double (*decode)(const char* bytes, bool swap);
};

template <typename T>
constexpr Type kType{sizeof(T), decode<T>};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count_type = nullptr;  ///< of a list
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

constexpr std::string_view kSpace = " \t\r\n";

class PlyReader {
 public:
  explicit PlyReader(const std::string& path) : path_(path), bytes_(readFile(path)) {}

  SurfaceFile read(Warnings* warnings) {
    readHeader();
    for (const Element& element : elements_) {
      for (long long i = 0; i < element.count; ++i) readItem(element, i);
    }
    SurfaceFile file = triangulated(soup_, path_, ": face ", warnings);
    for (const FileReference& picture : pictures_) file.materials.push_back(picture.name);
    file.references = std::move(pictures_);
    file.seen = std::move(seen_);
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}: {}: {}", path_, where, what));
  }

  void readHeader() {
    if (bytes_.compare(0, 3, "\xef\xbb\xbf") == 0) position_ = 3;
    asText(bytes_.substr(0, 2), path_);  // refuses UTF-16
    if (lowerCase(headerLine()) != "ply") fail("line 1", "the first line must be 'ply'");
    for (std::string line = headerLine(); line != "end_header"; line = headerLine()) readHeaderLine(line);
    if (format_.empty()) fail("header", "no format line");
  }

  /// All lines end as the first one: binary data may begin with the byte of another line end.
  std::string headerLine() {
    if (line_end_.empty()) {
      const std::size_t first = std::min(bytes_.find_first_of("\r\n"), bytes_.size());
      line_end_ = bytes_.compare(first, 2, "\r\n") == 0 ? "\r\n" : bytes_.substr(first, 1);
    }
    const std::size_t end = line_end_.empty() ? std::string::npos : bytes_.find(line_end_, position_);
    if (end == std::string::npos) fail("header", "no end_header line");
    std::string line = bytes_.substr(position_, end - position_);
    line.erase(line.find_last_not_of(kSpace) + 1);
    position_ = end + line_end_.size();
    ++line_;
    if (line.find('\0') != std::string::npos) fail(fmt::format("line {}", line_), "holds a zero byte");
    return line;
  }

  void readHeaderLine(const std::string& line) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") {
      words >> format_;
      const bool known =
          format_ == "ascii" || format_ == "binary_little_endian" || format_ == "binary_big_endian";
      if (!known) fail(fmt::format("line {}", line_), fmt::format("unknown format '{}'", format_));
    } else if (keyword == "element") {
      declareElement(line, words);
    } else if (keyword == "property") {
      declareProperty(line, words);
    } else if (keyword == "comment") {
      std::string kind, name;
      if (words >> kind && kind == "TextureFile" && std::getline(words >> std::ws, name))
        pictures_.push_back({path_, line_, kind, name});
    } else if (keyword != "obj_info" && !keyword.empty()) {
      badHeaderLine(line);
    }
  }

  void declareElement(const std::string& line, std::istringstream& words) {
    Element element;
    if (!(words >> element.name >> element.count) || element.count < 0) badHeaderLine(line);
    // Each element takes at least one byte: guards against counts without data.
    if (static_cast<unsigned long long>(element.count) > bytes_.size()) {
      fail(fmt::format("line {}", line_), fmt::format("announces {} elements '{}', but the file has {} bytes",
                                                      element.count, element.name, bytes_.size()));
    }
    elements_.push_back(element);
  }

  void declareProperty(const std::string& line, std::istringstream& words) {
    if (elements_.empty()) badHeaderLine(line);
    Property property;
    std::string type, count_type;
    words >> type;
    const bool is_list = type == "list";
    if (is_list) words >> count_type >> type;
    if (!(words >> property.name)) badHeaderLine(line);
    property.type = typeOf(type, line);
    if (is_list) property.count_type = typeOf(count_type, line);
    elements_.back().properties.push_back(property);
  }

  const Type* typeOf(const std::string& name, const std::string& line) const {
    static const std::map<std::string, const Type*> kTypes{
        {"char", &kType<std::int8_t>},     {"int8", &kType<std::int8_t>},
        {"uchar", &kType<std::uint8_t>},   {"uint8", &kType<std::uint8_t>},
        {"short", &kType<std::int16_t>},   {"int16", &kType<std::int16_t>},
        {"ushort", &kType<std::uint16_t>}, {"uint16", &kType<std::uint16_t>},
        {"int", &kType<std::int32_t>},     {"int32", &kType<std::int32_t>},
        {"uint", &kType<std::uint32_t>},   {"uint32", &kType<std::uint32_t>},
        {"float", &kType<float>},          {"float32", &kType<float>},
        {"double", &kType<double>},        {"float64", &kType<double>}};
    const auto type = kTypes.find(name);
    if (type == kTypes.end()) badHeaderLine(line);
    return type->second;
  }

  [[noreturn]] void badHeaderLine(const std::string& line) const {
    fail(fmt::format("line {}", line_), fmt::format("'{}' is not understood", line));
  }

  void readItem(const Element& element, long long item) {
    item_ = item;
    element_ = &element;
    values_.resize(element.properties.size());
    for (std::size_t p = 0; p < values_.size(); ++p) readProperty(element.properties[p], &values_[p]);
    if (element.name == "vertex") addVertex();
    if (element.name == "face") addFace();
    if (element.name == "tristrips")
      fail(where(), "triangle strips are not supported; open the file in MeshLab and save it again");
  }

  std::string where() const { return fmt::format("{} {} of {}", element_->name, item_, element_->count); }

  /// The value or values of the first property of the element that has one of the names. Empty if none has.
  const std::vector<double>& valuesOf(std::initializer_list<std::string_view> names) const {
    static const std::vector<double> kNone;
    for (std::size_t p = 0; p < values_.size(); ++p) {
      const std::string& name = element_->properties[p].name;
      if (std::find(names.begin(), names.end(), name) != names.end()) return values_[p];
    }
    return kNone;
  }

  double valueOf(std::initializer_list<std::string_view> names) const {
    const std::vector<double>& values = valuesOf(names);
    return values.empty() ? parseNumber("nan") : values.front();
  }

  void addVertex() {
    const Eigen::RowVector3d position(valueOf({"x"}), valueOf({"y"}), valueOf({"z"}));
    std::string message;
    if (!position.allFinite())
      message = fmt::format("{}: {}: x, y and z must be finite numbers", path_, where());
    soup_.addVertex(position, message);
    const std::vector<double>&u = valuesOf({"s", "u", "texture_u"}), &v = valuesOf({"t", "v", "texture_v"});
    has_vertex_texture_ = !u.empty() && !v.empty();
    if (has_vertex_texture_) soup_.texture.emplace_back(u.front(), v.front(), 0.0);
    const std::vector<double>& seen = valuesOf({"seen"});
    if (!seen.empty()) seen_.push_back(static_cast<float>(seen.front()));
  }

  /// Texture coordinates of the face's corners come before those of its vertices.
  void addFace() {
    const std::vector<double>&vertices = valuesOf({"vertex_indices", "vertex_index"}),
          &texture = valuesOf({"texcoord"});
    const bool has_texture = !texture.empty() && texture.size() == 2 * vertices.size();
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const int vertex = indexOf(vertices[k]);
      const int of_vertex = has_vertex_texture_ ? vertex : -1;
      corners.push_back({vertex, has_texture ? static_cast<int>(soup_.texture.size()) : of_vertex});
      if (has_texture) soup_.texture.emplace_back(texture[2 * k], texture[2 * k + 1], 0.0);
    }
    const double picture = valueOf({"texnumber"});
    const bool is_known = picture >= 0.0 && picture < static_cast<double>(pictures_.size());
    const int only = pictures_.size() == 1 ? 0 : -1;
    soup_.addFace(corners, is_known ? static_cast<int>(picture) : only, static_cast<int>(item_));
  }

  int indexOf(double value) const {
    if (!(value >= 0.0 && value < std::numeric_limits<int>::max() && value == std::floor(value)))
      fail(where(), fmt::format("'{}' is not a vertex index", value));
    return static_cast<int>(value);
  }

  void readProperty(const Property& property, std::vector<double>* values) {
    values->resize(property.count_type == nullptr ? 1 : readCount(property));
    for (double& value : *values) value = readValue(*property.type);
  }

  std::size_t readCount(const Property& list) {
    const double count = readValue(*list.count_type);
    // An ascii entry takes a space and a digit: guards against reserving more than the file can hold.
    const double bytes = format_ == "ascii" ? 2.0 : static_cast<double>(list.type->bytes);
    if (!(count >= 0.0 && bytes * count <= static_cast<double>(bytes_.size() - position_)))
      fail(where(), fmt::format("a list of {} entries does not fit into the rest of the file", count));
    return static_cast<std::size_t>(count);
  }

  double readValue(const Type& type) {
    if (format_ == "ascii") return parseNumber(readWord());
    if (bytes_.size() - position_ < type.bytes) fail(where(), "the file ends here");
    position_ += type.bytes;
    return type.decode(bytes_.data() + position_ - type.bytes, format_ == "binary_big_endian");
  }

  std::string_view readWord() {
    const std::size_t begin = bytes_.find_first_not_of(kSpace, position_);
    if (begin == std::string::npos) fail(where(), "the file ends here");
    position_ = std::min(bytes_.find_first_of(kSpace, begin), bytes_.size());
    return std::string_view(bytes_).substr(begin, position_ - begin);
  }

  std::string path_, bytes_;
  std::size_t position_ = 0;
  std::string line_end_, format_;
  int line_ = 0;
  std::vector<Element> elements_;
  std::vector<FileReference> pictures_;
  PolygonSoup soup_;
  bool has_vertex_texture_ = false;
  std::vector<float> seen_;
  const Element* element_ = nullptr;         ///< the current one
  long long item_ = 0;                       ///< its number
  std::vector<std::vector<double>> values_;  ///< of its properties
};

}  // namespace

SurfaceFile readPly(const std::string& path, Warnings* warnings) { return PlyReader(path).read(warnings); }

}  // namespace softbody
