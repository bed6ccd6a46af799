#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// The whole file. @throw std::invalid_argument if it cannot be read.
std::string readFile(const std::string& path);

/// The extension of a path in lower case, without its dot.
std::string extensionOf(const std::string& path);

/// A finite number, or NaN if the text is none.
double parseNumber(std::string_view text);

/// Reads a text file line by line; errors carry "file:line: ".
class TextReader {
 public:
  /// Comments run from '#' to the end of the line; a line that ends with '\' goes on with the next.
  /// @throw std::invalid_argument if the file cannot be read.
  explicit TextReader(std::string path);

  /// Goes to the next line that has fields. False at the end of the file.
  bool next();
  /// As next(), but the end of the file is an error that says what was expected.
  void require(const std::string& expected);

  const std::vector<std::string_view>& fields() const { return fields_; }
  std::string_view keyword() const { return fields_.front(); }
  int line() const { return line_; }
  const std::string& path() const { return path_; }

  /// The k-th field. @throw std::invalid_argument if it is missing or not what is asked for.
  double number(std::size_t k) const;
  int integer(std::size_t k) const;
  /// A count of things still to come: at least 0 and not more than the rest of the file could hold.
  int count(std::size_t k) const;
  Eigen::RowVector3d point(std::size_t first_field) const;

  [[noreturn]] void fail(const std::string& what) const { failAt(line_, what); }
  [[noreturn]] void failAt(int line, const std::string& what) const;

 private:
  std::string_view field(std::size_t k) const;
  std::string_view rawLine();

  std::string path_;
  std::string text_;
  std::string joined_;
  std::vector<std::string_view> fields_;
  std::size_t position_ = 0;
  int line_ = 0;
};

}  // namespace softbody
