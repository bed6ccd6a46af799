#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace softbody {

/// The extension of a path in lower case, without its dot.
std::string extensionOf(const std::string& path);

std::string lowerCase(std::string_view text);

/// The number in a text, or NaN if the text is not a finite number.
double parseNumber(std::string_view text);

/// Reads a text file line by line; errors carry "file:line: ".
class TextReader {
 public:
  /// A '\' at the end of an OBJ's line of numbers joins it with the next line.
  /// @throw std::invalid_argument as readTextFile.
  explicit TextReader(std::string path);

  /// Goes to the next line that has fields. False at the end of the file.
  bool next();
  /// Like next(), but throws at the end of the file. @param expected named in the error.
  void require(const std::string& expected);

  const std::vector<std::string_view>& fields() const { return fields_; }
  /// The first field in lower case.
  std::string keyword() const { return lowerCase(fields_.front()); }
  int line() const { return line_; }
  const std::string& path() const { return path_; }
  /// The line after its first field, without blanks and quotes around it: a name, which may contain blanks.
  std::string_view rest() const;

  /// The k-th field. @throw std::invalid_argument if it is missing or of another type.
  std::string_view field(std::size_t k) const;
  double number(std::size_t k) const;
  int integer(std::size_t k) const;
  /// A number of entries that follow: at least 0, at most what the rest of the file can hold.
  int count(std::size_t k) const;
  Eigen::RowVector3d point(std::size_t first_field) const;

  [[noreturn]] void fail(const std::string& what) const { failAt(line_, what); }
  [[noreturn]] void failAt(int line, const std::string& what) const;

 private:
  std::string_view rawLine();

  std::string path_;
  std::string text_;
  std::string joined_;
  std::vector<std::string_view> fields_;
  std::size_t position_ = 0;
  int line_ = 0;
};

}  // namespace softbody
