#include "io/vtu_file.h"

#include <fmt/format.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "io/stack_rows.h"
#include "io/text_reader.h"

namespace softbody {
namespace {

namespace pt = boost::property_tree;

class VtuReader {
 public:
  VtuReader(const std::string& path, Warnings* warnings) : path_(path), warnings_(warnings) {}

  TetMesh read() {
    const pt::ptree file = parse();
    const auto grid = file.get_child_optional("VTKFile.UnstructuredGrid");
    if (!grid) fail("no <UnstructuredGrid>; only unstructured grids are supported");
    int pieces = 0;
    for (const auto& [name, piece] : *grid) {
      if (name == "Piece") {
        readPiece(piece);
        ++pieces;
      }
    }
    if (pieces == 0) fail("no <Piece>");
    if (skipped_ > 0) {
      warnings_->push_back(fmt::format("{}: {} cells other than tets (the first of VTK type {}) were skipped",
                                       path_, skipped_, first_skipped_type_));
    }
    return {stackRows<Points>(vertices_), stackRows<Tets>(tets_)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw std::invalid_argument(path_ + ": " + what); }

  pt::ptree parse() const {
    std::ifstream stream(path_);
    if (!stream) fail("cannot be read");
    pt::ptree file;
    try {
      pt::read_xml(stream, file);
    } catch (const pt::xml_parser_error& error) {
      throw std::invalid_argument(fmt::format("{}:{}: not XML: {}", path_, error.line(), error.message()));
    }
    return file;
  }

  void readPiece(const pt::ptree& piece) {
    const std::vector<double> points = numbers(piece, "Points", "");
    const auto announced_points = piece.get<long long>("<xmlattr>.NumberOfPoints", -1);
    const auto announced_cells = piece.get<long long>("<xmlattr>.NumberOfCells", -1);
    if (announced_points < 0 || announced_cells < 0) fail("<Piece> without NumberOfPoints or NumberOfCells");
    if (static_cast<long long>(points.size()) != 3 * announced_points) {
      fail(fmt::format("NumberOfPoints is {}, but <Points> holds {} numbers", announced_points,
                       points.size()));
    }
    const auto first = static_cast<int>(vertices_.size());
    for (std::size_t p = 0; p < points.size(); p += 3)
      vertices_.emplace_back(points[p], points[p + 1], points[p + 2]);
    readCells(piece, announced_cells, first);
  }

  void readCells(const pt::ptree& piece, long long announced, int first_vertex) {
    const std::vector<double> connectivity = numbers(piece, "Cells", "connectivity");
    const std::vector<double> offsets = numbers(piece, "Cells", "offsets");
    const std::vector<double> types = numbers(piece, "Cells", "types");
    if (static_cast<long long>(types.size()) != announced || offsets.size() != types.size()) {
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
    if (type != kVtkTetra) {
      if (skipped_++ == 0) first_skipped_type_ = type;
      return;
    }
    if (end - begin != 4.0) fail(fmt::format("cell {}: a tet of {} vertices", cell, end - begin));
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
  std::vector<double> numbers(const pt::ptree& piece, const std::string& section,
                              const std::string& name) const {
    const auto arrays = piece.get_child_optional(section);
    if (!arrays) fail(fmt::format("no <{}>", section));
    for (const auto& [tag, array] : *arrays) {
      if (tag != "DataArray") continue;
      if (!name.empty() && array.get<std::string>("<xmlattr>.Name", "") != name) continue;
      const std::string label = fmt::format("<{}> {}", section, name);
      const auto format = array.get<std::string>("<xmlattr>.format", "ascii");
      if (format != "ascii") fail(fmt::format("{}: format is '{}'; only ascii is supported", label, format));
      return parseNumbers(array.data(), label);
    }
    fail(fmt::format("no DataArray {} in <{}>", name, section));
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
  std::size_t skipped_ = 0;
  double first_skipped_type_ = 0.0;
};

}  // namespace

TetMesh readVtu(const std::string& path, Warnings* warnings) { return VtuReader(path, warnings).read(); }

}  // namespace softbody
