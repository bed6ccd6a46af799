#include "io/vtu_file.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "softbody_common/files/stack_rows.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

using tinyxml2::XMLElement;

constexpr int kVtkQuadraticTetra = 24;

/// Empty if there is no such attribute.
std::string_view attributeOf(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? std::string_view() : value;
}

class VtuReader {
 public:
  VtuReader(const std::string& path, Warnings* warnings) : path_(path), warnings_(warnings) {}

  TetMesh read(std::string_view text) {
    // Appended data may be bytes that are not XML.
    if (text.find("<AppendedData") != std::string_view::npos) failBinary("appended");
    tinyxml2::XMLDocument file;
    if (file.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw std::invalid_argument(fmt::format("{}:{}: not XML ({}): save the file again", path_,
                                              file.ErrorLineNum(), file.ErrorName()));
    }
    const XMLElement* root = file.FirstChildElement("VTKFile");
    const XMLElement* grid = root == nullptr ? nullptr : root->FirstChildElement("UnstructuredGrid");
    if (grid == nullptr) fail("no <UnstructuredGrid>; only unstructured grids are supported");
    const XMLElement* piece = grid->FirstChildElement("Piece");
    if (piece == nullptr) fail("no <Piece>");
    for (; piece != nullptr; piece = piece->NextSiblingElement("Piece")) readPiece(*piece);
    if (skipped_ > 0) {
      warnings_->push_back(fmt::format("{}: {} cells other than tets (the first of VTK type {}) were skipped",
                                       path_, skipped_, first_skipped_type_));
    }
    if (quadratic_ > 0)
      warnings_->push_back(
          fmt::format("{}: {} tets have 10 nodes; only their corners were taken", path_, quadratic_));
    return {stackRows<Points>(vertices_), stackRows<Tets>(tets_)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw std::invalid_argument(path_ + ": " + what); }

  [[noreturn]] void failBinary(std::string_view format) const {
    fail(fmt::format(
        "format is '{}'; only ascii is supported; convert it: meshio convert --ascii {} ascii.vtu, or "
        "save it in ParaView with data mode Ascii",
        format, path_));
  }

  /// The whole number of an attribute, at least 0.
  std::size_t count(const XMLElement& piece, const char* name) const {
    const std::string_view text = attributeOf(piece, name);
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("<Piece>: {} is '{}'; allowed: a whole number", name, text));
    return value;
  }

  void readPiece(const XMLElement& piece) {
    const std::vector<double> points = numbers(piece, "Points", "");
    const std::size_t announced_points = count(piece, "NumberOfPoints");
    const std::size_t announced_cells = count(piece, "NumberOfCells");
    if (points.size() % 3 != 0 || points.size() / 3 != announced_points) {
      fail(fmt::format("NumberOfPoints is {}, but <Points> holds {} numbers", announced_points,
                       points.size()));
    }
    const auto first = static_cast<int>(vertices_.size());
    for (std::size_t p = 0; p < points.size(); p += 3)
      vertices_.emplace_back(points[p], points[p + 1], points[p + 2]);
    readCells(piece, announced_cells, first);
  }

  void readCells(const XMLElement& piece, std::size_t announced, int first_vertex) {
    const std::vector<double> connectivity = numbers(piece, "Cells", "connectivity");
    const std::vector<double> offsets = numbers(piece, "Cells", "offsets");
    const std::vector<double> types = numbers(piece, "Cells", "types");
    if (types.size() != announced || offsets.size() != types.size()) {
      fail(fmt::format("NumberOfCells is {}, but there are {} offsets and {} types", announced,
                       offsets.size(), types.size()));
    }
    double begin = 0.0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      if (!(offsets[c] >= begin && offsets[c] <= static_cast<double>(connectivity.size()))) {
        fail(fmt::format("cell {}: offset {} is not between {} and {}", c, offsets[c], begin,
                         connectivity.size()));
      }
      addCell(c, types[c], connectivity, begin, offsets[c], first_vertex);
      begin = offsets[c];
    }
  }

  void addCell(std::size_t cell, double type, const std::vector<double>& connectivity, double begin,
               double end, int first_vertex) {
    if (type != kVtkTetra && type != kVtkQuadraticTetra) {
      if (skipped_++ == 0) first_skipped_type_ = type;
      return;
    }
    quadratic_ += type == kVtkTetra ? 0 : 1;
    if (end - begin != (type == kVtkTetra ? 4.0 : 10.0))
      fail(fmt::format("cell {}: a tet has {} vertices", cell, end - begin));
    Eigen::RowVector4i tet;
    for (int k = 0; k < 4; ++k) {
      const double vertex = connectivity[static_cast<std::size_t>(begin) + static_cast<std::size_t>(k)];
      const double count = static_cast<double>(vertices_.size()) - first_vertex;
      if (!(vertex >= 0.0 && vertex < count && vertex == std::floor(vertex))) {
        fail(fmt::format("cell {}: refers to point {}; there are {}", cell, vertex, count));
      }
      tet[k] = first_vertex + static_cast<int>(vertex);
    }
    tets_.push_back(tet);
  }

  /// The numbers of the DataArray of that name (empty: the only one) in a section.
  std::vector<double> numbers(const XMLElement& piece, const char* section, const std::string& name) const {
    const XMLElement* arrays = piece.FirstChildElement(section);
    if (arrays == nullptr) fail(fmt::format("no <{}>", section));
    const XMLElement* array = arrays->FirstChildElement("DataArray");
    while (array != nullptr && !name.empty() && attributeOf(*array, "Name") != name)
      array = array->NextSiblingElement("DataArray");
    if (array == nullptr) fail(fmt::format("no DataArray {} in <{}>", name, section));
    const std::string_view format = attributeOf(*array, "format");
    if (!format.empty() && format != "ascii") failBinary(format);
    const char* text = array->GetText();
    return parseNumbers(text == nullptr ? "" : text, fmt::format("<{}> {}", section, name));
  }

  std::vector<double> parseNumbers(std::string_view text, const std::string& label) const {
    static constexpr const char* kSpace = " \t\r\n";
    std::vector<double> values;
    std::size_t begin = 0;
    while ((begin = text.find_first_not_of(kSpace, begin)) != std::string_view::npos) {
      const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
      values.push_back(parseNumber(text.substr(begin, end - begin)));
      if (std::isnan(values.back())) {
        fail(fmt::format("{}, entry {}: '{}' is not a finite number", label, values.size() - 1,
                         text.substr(begin, end - begin)));
      }
      begin = end;
    }
    return values;
  }

  std::string path_;
  Warnings* warnings_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<Eigen::RowVector4i> tets_;
  std::size_t skipped_ = 0, quadratic_ = 0;
  double first_skipped_type_ = 0.0;
};

}  // namespace

TetMesh parseVtu(const std::string& path, std::string_view text, Warnings* warnings) {
  return VtuReader(path, warnings).read(text);
}

}  // namespace softbody
