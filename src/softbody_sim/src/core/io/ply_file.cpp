#include "io/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "io/stack_rows.h"
#include "io/text_reader.h"
#include "softbody_common/files/input_file.h"

namespace softbody {
namespace {

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  std::string name;
  Type type = Type::kFloat;
  bool is_list = false;
  Type count_type = Type::kUint8;
};

struct Element {
  std::string name;
  long long count = 0;
  std::vector<Property> properties;
};

template <typename T>
double decode(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::copy(bytes, bytes + sizeof(T), ordered);
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return static_cast<double>(value);
}

double decode(Type type, const char* bytes, bool swap) {
  switch (type) {
    case Type::kInt8:
      return decode<std::int8_t>(bytes, swap);
    case Type::kUint8:
      return decode<std::uint8_t>(bytes, swap);
    case Type::kInt16:
      return decode<std::int16_t>(bytes, swap);
    case Type::kUint16:
      return decode<std::uint16_t>(bytes, swap);
    case Type::kInt32:
      return decode<std::int32_t>(bytes, swap);
    case Type::kUint32:
      return decode<std::uint32_t>(bytes, swap);
    case Type::kFloat:
      return decode<float>(bytes, swap);
    case Type::kDouble:
      return decode<double>(bytes, swap);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

class PlyReader {
 public:
  explicit PlyReader(std::string path) : path_(std::move(path)), text_(readFile(path_)) {}

  SurfaceFile read() {
    readHeader();
    for (const Element& element : elements_) {
      for (long long i = 0; i < element.count; ++i) readItem(element, i);
    }
    checkTriangles();
    SurfaceFile file{{stackRows<Points>(vertices_), stackRows<Triangles>(triangles_)}, {}};
    if (!texture_.empty()) file.texture_coordinates = cornerTexture();
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}: {}: {}", path_, where, what));
  }

  void readHeader() {
    if (headerLine() != "ply") fail("line 1", "the first line must be 'ply'");
    for (std::string line = headerLine(); line != "end_header"; line = headerLine()) readHeaderLine(line);
    if (format_.empty()) fail("header", "no format line");
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0)
        fail("header", fmt::format("the element '{}' has no properties", element.name));
    }
  }

  std::string headerLine() {
    const std::size_t end = text_.find('\n', position_);
    if (end == std::string::npos) fail("header", "no end_header line");
    std::string line = text_.substr(position_, end - position_);
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.pop_back();
    position_ = end + 1;
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
      Element element;
      if (!(words >> element.name >> element.count) || element.count < 0) badHeaderLine(line);
      // Each element takes at least one byte: guards against counts without data.
      if (static_cast<unsigned long long>(element.count) > text_.size()) {
        fail(fmt::format("line {}", line_),
             fmt::format("announces {} elements '{}', but the file has {} bytes", element.count, element.name,
                         text_.size()));
      }
      elements_.push_back(element);
    } else if (keyword == "property") {
      readProperty(line, words);
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      badHeaderLine(line);
    }
  }

  void readProperty(const std::string& line, std::istringstream& words) {
    if (elements_.empty()) badHeaderLine(line);
    Property property;
    std::string type, count_type;
    words >> type;
    property.is_list = type == "list";
    if (property.is_list) words >> count_type >> type;
    if (!(words >> property.name)) badHeaderLine(line);
    property.type = typeOf(type, line);
    if (property.is_list) property.count_type = typeOf(count_type, line);
    elements_.back().properties.push_back(property);
  }

  Type typeOf(const std::string& name, const std::string& line) const {
    static const std::map<std::string, Type> kTypes{
        {"char", Type::kInt8},     {"int8", Type::kInt8},     {"uchar", Type::kUint8},
        {"uint8", Type::kUint8},   {"short", Type::kInt16},   {"int16", Type::kInt16},
        {"ushort", Type::kUint16}, {"uint16", Type::kUint16}, {"int", Type::kInt32},
        {"int32", Type::kInt32},   {"uint", Type::kUint32},   {"uint32", Type::kUint32},
        {"float", Type::kFloat},   {"float32", Type::kFloat}, {"double", Type::kDouble},
        {"float64", Type::kDouble}};
    const auto type = kTypes.find(name);
    if (type == kTypes.end()) badHeaderLine(line);
    return type->second;
  }

  [[noreturn]] void badHeaderLine(const std::string& line) const {
    fail(fmt::format("line {}", line_), fmt::format("'{}' is not understood", line));
  }

  void readItem(const Element& element, long long item) {
    where_ = fmt::format("{} {} of {}", element.name, item, element.count);
    Eigen::RowVector3d vertex = Eigen::RowVector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    Eigen::RowVector3d texture = vertex;
    for (const Property& property : element.properties) {
      if (property.is_list) {
        const std::vector<double> list = readList(property);
        if (element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index"))
          addFan(list);
      } else {
        const double value = readValue(property.type);
        if (element.name == "vertex") assign(property.name, value, &vertex, &texture);
      }
    }
    if (element.name == "vertex") addVertex(vertex, texture);
  }

  static void assign(const std::string& name, double value, Eigen::RowVector3d* vertex,
                     Eigen::RowVector3d* texture) {
    if (name == "x") (*vertex)[0] = value;
    if (name == "y") (*vertex)[1] = value;
    if (name == "z") (*vertex)[2] = value;
    if (name == "s" || name == "u" || name == "texture_u") (*texture)[0] = value;
    if (name == "t" || name == "v" || name == "texture_v") (*texture)[1] = value;
  }

  void addVertex(const Eigen::RowVector3d& vertex, const Eigen::RowVector3d& texture) {
    if (!vertex.allFinite()) fail(where_, "x, y and z must be finite numbers");
    vertices_.push_back(vertex);
    if (texture.head<2>().allFinite()) texture_.emplace_back(texture[0], texture[1], 0.0);
  }

  std::vector<double> readList(const Property& property) {
    const double count = readValue(property.count_type);
    // An ascii entry takes a space and a digit: guards against reserving more than the file can hold.
    const double bytes = format_ == "ascii" ? 2.0 : kBytes[static_cast<int>(property.type)];
    if (!(count >= 0.0 && bytes * count <= static_cast<double>(text_.size() - position_))) {
      fail(where_, fmt::format("a list of {} entries does not fit into the rest of the file", count));
    }
    std::vector<double> list;
    list.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < static_cast<int>(count); ++k) list.push_back(readValue(property.type));
    return list;
  }

  double readValue(Type type) {
    if (format_ == "ascii") return readWord();
    const auto bytes = static_cast<std::size_t>(kBytes[static_cast<int>(type)]);
    if (text_.size() - position_ < bytes) fail(where_, "the file ends here");
    const double value = decode(type, text_.data() + position_, format_ == "binary_big_endian");
    position_ += bytes;
    return value;
  }

  double readWord() {
    static constexpr const char* kSpace = " \t\r\n";
    const std::size_t begin = text_.find_first_not_of(kSpace, position_);
    if (begin == std::string::npos) fail(where_, "the file ends here");
    position_ = std::min(text_.find_first_of(kSpace, begin), text_.size());
    const std::string_view word = std::string_view(text_).substr(begin, position_ - begin);
    const double value = parseNumber(word);
    if (std::isnan(value)) fail(where_, fmt::format("'{}' is not a finite number", word));
    return value;
  }

  void addFan(const std::vector<double>& corners) {
    if (corners.size() < 3) fail(where_, fmt::format("a face of {} corners", corners.size()));
    for (const double corner : corners) {
      const bool whole =
          corner >= 0.0 && corner < std::numeric_limits<int>::max() && corner == std::floor(corner);
      if (!whole) fail(where_, fmt::format("'{}' is not a vertex index", corner));
    }
    const auto corner = [&corners](std::size_t k) { return static_cast<int>(corners[k]); };
    for (std::size_t k = 2; k < corners.size(); ++k)
      triangles_.emplace_back(corner(0), corner(k - 1), corner(k));
  }

  void checkTriangles() const {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const int largest = triangles_[f].maxCoeff();
      if (static_cast<std::size_t>(largest) < vertices_.size()) continue;
      fail(fmt::format("triangle {}", f),
           fmt::format("refers to vertex {}; the file has {} vertices", largest, vertices_.size()));
    }
  }

  Points cornerTexture() const {
    if (texture_.size() != vertices_.size()) return {};
    Points corners(static_cast<Eigen::Index>(3 * triangles_.size()), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      for (int k = 0; k < 3; ++k)
        corners.row(static_cast<Eigen::Index>(3 * f) + k) = texture_[triangles_[f][k]];
    }
    return corners;
  }

  std::string path_;
  std::string text_;
  std::size_t position_ = 0;
  int line_ = 0;
  std::string where_;
  std::string format_;
  std::vector<Element> elements_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<Eigen::RowVector3d> texture_;
  std::vector<Eigen::RowVector3i> triangles_;
};

}  // namespace

SurfaceFile readPly(const std::string& path) { return PlyReader(path).read(); }

}  // namespace softbody
