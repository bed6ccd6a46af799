#include "softbody_common/files/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "softbody_common/files/input_file.h"
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

template <typename T>
constexpr PlyType kType{
    sizeof(T), std::numeric_limits<T>::is_integer ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0,
    decode<T>};

constexpr std::string_view kSpace = " \t\r\n";

}  // namespace

PlyReader::PlyReader(const std::string& path) : path_(path), bytes_(readFile(path)) { readHeader(); }

void PlyReader::fail(const std::string& where, const std::string& what) const {
  throw std::invalid_argument(fmt::format("{}: {}: {}", path_, where, what));
}

void PlyReader::readHeader() {
  if (bytes_.compare(0, 3, "\xef\xbb\xbf") == 0) position_ = 3;
  asText(bytes_.substr(0, 2), path_);  // refuses UTF-16
  if (lowerCase(headerLine()) != "ply") fail("line 1", "the first line must be 'ply'");
  for (std::string line = headerLine(); line != "end_header"; line = headerLine()) readHeaderLine(line);
  if (format_.empty()) fail("header", "no format line");
}

/// All lines end as the first one: binary data may begin with the byte of another line end.
std::string PlyReader::headerLine() {
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

void PlyReader::readHeaderLine(const std::string& line) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "format") {
    words >> format_;
    const bool known =
        format_ == "ascii" || format_ == "binary_little_endian" || format_ == "binary_big_endian";
    if (!known) fail(fmt::format("line {}", line_), fmt::format("the format '{}' is unknown", format_));
  } else if (keyword == "element") {
    declareElement(line, words);
  } else if (keyword == "property") {
    declareProperty(line, words);
  } else if (keyword == "comment") {
    Comment comment{line_, {}, {}};
    if (words >> comment.keyword) std::getline(words >> std::ws, comment.rest);
    comments_.push_back(comment);
  } else if (keyword != "obj_info" && !keyword.empty()) {
    badHeaderLine(line);
  }
}

void PlyReader::declareElement(const std::string& line, std::istringstream& words) {
  Element element;
  if (!(words >> element.name >> element.count) || element.count < 0) badHeaderLine(line);
  // Each element takes at least one byte: guards against counts without data.
  if (static_cast<unsigned long long>(element.count) > bytes_.size()) {
    fail(fmt::format("line {}", line_), fmt::format("announces {} elements '{}', but the file has {} bytes",
                                                    element.count, element.name, bytes_.size()));
  }
  elements_.push_back(element);
}

void PlyReader::declareProperty(const std::string& line, std::istringstream& words) {
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

const PlyType* PlyReader::typeOf(const std::string& name, const std::string& line) const {
  static const std::map<std::string, const PlyType*> kTypes{
      {"char", &kType<std::int8_t>},     {"int8", &kType<std::int8_t>},     {"uchar", &kType<std::uint8_t>},
      {"uint8", &kType<std::uint8_t>},   {"short", &kType<std::int16_t>},   {"int16", &kType<std::int16_t>},
      {"ushort", &kType<std::uint16_t>}, {"uint16", &kType<std::uint16_t>}, {"int", &kType<std::int32_t>},
      {"int32", &kType<std::int32_t>},   {"uint", &kType<std::uint32_t>},   {"uint32", &kType<std::uint32_t>},
      {"float", &kType<float>},          {"float32", &kType<float>},        {"double", &kType<double>},
      {"float64", &kType<double>}};
  const auto type = kTypes.find(name);
  if (type == kTypes.end()) badHeaderLine(line);
  return type->second;
}

void PlyReader::badHeaderLine(const std::string& line) const {
  fail(fmt::format("line {}", line_), fmt::format("'{}' is not understood", line));
}

bool PlyReader::next() {
  ++item_;
  while (element_ < elements_.size() && item_ == elements_[element_].count) {
    ++element_;
    item_ = 0;
  }
  if (element_ == elements_.size()) return false;
  const std::vector<Property>& properties = elements_[element_].properties;
  values_.resize(properties.size());
  for (std::size_t p = 0; p < values_.size(); ++p) readProperty(properties[p], &values_[p]);
  return true;
}

std::string PlyReader::where() const {
  return fmt::format("{} {} of {}", element(), item_, elements_[element_].count);
}

/// The number of properties if none has one of the names.
std::size_t PlyReader::placeOf(std::initializer_list<std::string_view> names) const {
  const std::vector<Property>& properties = elements_[element_].properties;
  const auto found = std::find_if(properties.begin(), properties.end(), [&](const Property& property) {
    return std::find(names.begin(), names.end(), property.name) != names.end();
  });
  return static_cast<std::size_t>(found - properties.begin());
}

const std::vector<double>& PlyReader::valuesOf(std::initializer_list<std::string_view> names) const {
  static const std::vector<double> kNone;
  const std::size_t place = placeOf(names);
  return place == values_.size() ? kNone : values_[place];
}

double PlyReader::valueOf(std::initializer_list<std::string_view> names) const {
  const std::vector<double>& values = valuesOf(names);
  return values.empty() ? parseNumber("nan") : values.front();
}

double PlyReader::shareOf(std::initializer_list<std::string_view> names) const {
  const std::size_t place = placeOf(names);
  return place == values_.size() ? parseNumber("nan")
                                 : valueOf(names) / elements_[element_].properties[place].type->largest;
}

void PlyReader::readProperty(const Property& property, std::vector<double>* values) {
  values->resize(property.count_type == nullptr ? 1 : readCount(property));
  for (double& value : *values) value = readValue(*property.type);
}

std::size_t PlyReader::readCount(const Property& list) {
  const double count = readValue(*list.count_type);
  // An ascii entry takes a space and a digit: guards against reserving more than the file can hold.
  const double bytes = format_ == "ascii" ? 2.0 : static_cast<double>(list.type->bytes);
  if (!(count >= 0.0 && bytes * count <= static_cast<double>(bytes_.size() - position_)))
    fail(fmt::format("a list of {} entries does not fit into the rest of the file", count));
  return static_cast<std::size_t>(count);
}

double PlyReader::readValue(const PlyType& type) {
  if (format_ == "ascii") return parseNumber(readWord());
  if (bytes_.size() - position_ < type.bytes) fail("the file ends here");
  position_ += type.bytes;
  return type.decode(bytes_.data() + position_ - type.bytes, format_ == "binary_big_endian");
}

std::string_view PlyReader::readWord() {
  const std::size_t begin = bytes_.find_first_not_of(kSpace, position_);
  if (begin == std::string::npos) fail("the file ends here");
  position_ = std::min(bytes_.find_first_of(kSpace, begin), bytes_.size());
  return std::string_view(bytes_).substr(begin, position_ - begin);
}

}  // namespace softbody
