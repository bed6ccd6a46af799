#include "softbody_common/files/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>

#include "softbody_common/files/input_file.h"

namespace softbody {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kBlank(" \t\f\v\0\x1a", 6);  // some files end with a zero byte or Ctrl-Z

void splitFields(std::string_view line, std::vector<std::string_view>* fields) {
  fields->clear();
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(kBlank, begin)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    fields->push_back(line.substr(begin, end - begin));
    begin = end;
  }
}

/// Names may end with a backslash: "g C:\\scans\\". Numbers do not.
bool continues(std::string_view line) {
  static const std::set<std::string_view> kNumbers{"v", "vt", "vn", "vp", "f", "l", "p"};
  if (line.empty() || line.back() != '\\') return false;
  std::vector<std::string_view> fields;
  splitFields(line, &fields);
  return kNumbers.count(fields.front()) > 0;
}

}  // namespace

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  return lowerCase(extension);
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

double parseNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return kNan;
  // from_chars also rejects denormal numbers; strtod gives the nearest double.
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);
  return std::isfinite(value) && error != std::errc::invalid_argument ? value : kNan;
}

TextReader::TextReader(std::string path) : path_(std::move(path)), text_(readTextFile(path_)) {}

std::string_view TextReader::rawLine() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = std::string_view(text_).substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  ++line_;
  return withoutComment(line);
}

bool TextReader::next() {
  while (position_ < text_.size()) {
    std::string_view line = rawLine();
    if (continues(line)) {
      joined_.clear();
      for (; !line.empty() && line.back() == '\\'; line = position_ < text_.size() ? rawLine() : "")
        joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
      line = joined_.append(line);
    }
    splitFields(line, &fields_);
    if (!fields_.empty()) return true;
  }
  return false;
}

std::string_view TextReader::rest() const {
  if (fields_.size() < 2) return {};
  const char* const begin = fields_[1].data();
  const std::string_view name(
      begin, static_cast<std::size_t>(fields_.back().data() + fields_.back().size() - begin));
  const bool is_quoted = name.size() > 1 && name.front() == '"' && name.back() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

void TextReader::require(const std::string& expected) {
  if (!next()) fail("the file ends before " + expected);
}

std::string_view TextReader::field(std::size_t k) const {
  if (k >= fields_.size()) fail(fmt::format("{} fields instead of at least {}", fields_.size(), k + 1));
  return fields_[k];
}

double TextReader::number(std::size_t k) const {
  const double value = parseNumber(field(k));
  if (std::isnan(value)) fail(fmt::format("'{}' is not a finite number", field(k)));
  return value;
}

int TextReader::integer(std::size_t k) const {
  std::string_view text = field(k);
  if (text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail(fmt::format("'{}' is not a whole number", field(k)));
  }
  return value;
}

int TextReader::count(std::size_t k) const {
  const int value = integer(k);
  // Each entry takes at least two characters.
  const std::size_t most = (text_.size() - position_ + 1) / 2;
  if (value < 0 || static_cast<std::size_t>(value) > most) {
    fail(fmt::format("announces {} entries; the rest of the file cannot hold them", value));
  }
  return value;
}

Eigen::RowVector3d TextReader::point(std::size_t first_field) const {
  return {number(first_field), number(first_field + 1), number(first_field + 2)};
}

void TextReader::failAt(int line, const std::string& what) const {
  throw std::invalid_argument(fmt::format("{}:{}: {}", path_, line, what));
}

}  // namespace softbody
