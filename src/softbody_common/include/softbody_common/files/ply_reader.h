#pragma once

#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace softbody {

/// A number type of PLY.
struct PlyType {
  std::size_t bytes;
  double largest;  ///< of a whole number; 1 for floating-point numbers
  double (*decode)(const char* bytes, bool swap);
};

/// Reads a Polygon File Format file (ascii, or binary of both byte orders) item by item; errors carry the
/// file and the line or item.
class PlyReader {
 public:
  /// A comment of the header.
  struct Comment {
    int line = 0;
    std::string keyword, rest;
  };

  /// Reads the header. @throw std::invalid_argument as readFile, and if it is not understood.
  explicit PlyReader(const std::string& path);

  const std::vector<Comment>& comments() const { return comments_; }

  /// Goes to the next item, e.g. a vertex. False after the last one. @throw std::invalid_argument if the file
  /// ends before.
  bool next();
  /// The name of the item's element, and its number among those.
  const std::string& element() const { return elements_[element_].name; }
  long long item() const { return item_; }

  /// The value or values of the first property of the item that has one of the names. Empty if none has.
  const std::vector<double>& valuesOf(std::initializer_list<std::string_view> names) const;
  /// The first of them, or NaN.
  double valueOf(std::initializer_list<std::string_view> names) const;
  /// The same as a share of what its type can hold: 255 of a byte is 1. Floating-point numbers stay as they
  /// are.
  double shareOf(std::initializer_list<std::string_view> names) const;

  /// The item, for messages.
  std::string where() const;
  /// @throw std::invalid_argument with file and item.
  [[noreturn]] void fail(const std::string& what) const { fail(where(), what); }

 private:
  struct Property {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count_type = nullptr;  ///< of a list
  };
  struct Element {
    std::string name;
    long long count = 0;
    std::vector<Property> properties;
  };

  [[noreturn]] void fail(const std::string& where, const std::string& what) const;
  void readHeader();
  std::string headerLine();
  void readHeaderLine(const std::string& line);
  void declareElement(const std::string& line, std::istringstream& words);
  void declareProperty(const std::string& line, std::istringstream& words);
  const PlyType* typeOf(const std::string& name, const std::string& line) const;
  [[noreturn]] void badHeaderLine(const std::string& line) const;
  std::size_t placeOf(std::initializer_list<std::string_view> names) const;
  void readProperty(const Property& property, std::vector<double>* values);
  std::size_t readCount(const Property& list);
  double readValue(const PlyType& type);
  std::string_view readWord();

  std::string path_, bytes_;
  std::size_t position_ = 0;
  std::string line_end_, format_;
  int line_ = 0;
  std::vector<Element> elements_;
  std::vector<Comment> comments_;
  std::size_t element_ = 0;                  ///< the current one
  long long item_ = -1;                      ///< its number
  std::vector<std::vector<double>> values_;  ///< of its properties
};

}  // namespace softbody
