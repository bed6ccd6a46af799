#include "marker_board/marker_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

constexpr double kEdge_m = 0.010;       // [m] edge of the paper that printers leave blank
constexpr double kBottom_m = 0.030;     // [m] height of the ruler and its text
constexpr double kLabel_m = 0.006;      // [m] height of the text below a marker
constexpr double kMinMarker_m = 0.003;  // [m] smallest marker that is laid out
constexpr int kFirstSheetId = 50;       // DICT_4X4_50 has the first 50 codes of DICT_4X4_100

const std::map<std::string, std::pair<double, double>>& papers() {
  static const std::map<std::string, std::pair<double, double>> kPapers{
      {"a3", {0.297, 0.420}}, {"a4", {0.210, 0.297}}, {"a5", {0.148, 0.210}}, {"letter", {0.2159, 0.2794}}};
  return kPapers;
}

void checkIds(const std::string& dictionary, const std::vector<int>& ids) {
  const int count = markersInDictionary(dictionary);
  std::set<int> seen;
  for (const int id : ids) {
    if (id < 0 || id >= count)
      throw std::invalid_argument(
          fmt::format("marker id is {}; allowed in {}: 0 to {}", id, dictionary, count - 1));
    if (!seen.insert(id).second) throw std::invalid_argument(fmt::format("marker id {} is given twice", id));
  }
  if (ids.empty()) throw std::invalid_argument("a board needs at least one marker id");
}

void checkSize(double size_m) {
  if (!(size_m >= kMinMarker_m))
    throw std::invalid_argument(fmt::format("markers of {:g} mm are too small; allowed: {:g} mm or more",
                                            1e3 * size_m, 1e3 * kMinMarker_m));
}

/// Middles of equal markers in a row from edge to edge, around 0 [m].
/// @param margin_m white margin of a marker. @return less than two: they do not fit.
std::vector<double> placesInRow(double length_m, double size_m, double margin_m) {
  const double room = length_m - 2.0 * kEdge_m, span = room - size_m;
  const int count = static_cast<int>(span / (size_m + 2.0 * margin_m)) + 1;
  std::vector<double> places;
  for (int i = 0; span > 0.0 && count > 1 && i < count; ++i)
    places.push_back((double(i) / (count - 1) - 0.5) * span);
  return places;
}

/// The ring's places, clockwise from the top left.
std::vector<Eigen::Vector2d> ringOf(const std::vector<double>& across, const std::vector<double>& up) {
  std::vector<Eigen::Vector2d> ring;
  for (const double x : across) ring.emplace_back(x, up.back());
  for (std::size_t i = up.size() - 1; i-- > 1;) ring.emplace_back(across.back(), up[i]);
  for (std::size_t i = across.size(); i-- > 0;) ring.emplace_back(across[i], up.front());
  for (std::size_t i = 1; i + 1 < up.size(); ++i) ring.emplace_back(across.front(), up[i]);
  return ring;
}

/// Whole millimetres.
double usualSheetMarker(const MarkerBoard& sheet) {
  return 1e-3 * std::floor(1e3 * sheet.paper_width_m * 2.0 / 15.0);
}

}  // namespace

std::vector<std::string> paperNames() {
  std::vector<std::string> names;
  for (const auto& [name, size] : papers()) names.push_back(name);
  return names;
}

MarkerBoard boardPaper(const std::string& paper) {
  const auto found = papers().find(paper);
  if (found == papers().end())
    throw std::invalid_argument(
        fmt::format("paper is '{}'; allowed: {}", paper, fmt::join(paperNames(), ", ")));
  MarkerBoard board;
  board.paper_width_m = found->second.first;
  board.paper_height_m = found->second.second;
  return board;
}

MarkerBoard layOutBoard(const std::string& dictionary, const std::vector<int>& ids, double size_m,
                        const std::string& paper) {
  checkIds(dictionary, ids);
  checkSize(size_m);
  MarkerBoard board = boardPaper(paper);
  board.tool.dictionary = dictionary;
  // The detector needs a white margin of one cell on each side.
  const double pitch_x = size_m * (1.0 + 2.0 / markerCells(dictionary, ids.front()).cols);
  const double pitch_y = pitch_x + kLabel_m;
  const int columns = std::min(static_cast<int>(ids.size()),
                               static_cast<int>((board.paper_width_m - 2.0 * kEdge_m) / pitch_x));
  const int rows = columns > 0 ? (static_cast<int>(ids.size()) + columns - 1) / columns : 0;
  if (columns == 0 || rows * pitch_y > board.paper_height_m - 2.0 * kEdge_m - 2.0 * kBottom_m) {
    throw std::invalid_argument(fmt::format("{} markers of {:g} mm with their margins do not fit on {} paper",
                                            ids.size(), 1e3 * size_m, paper));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    ToolMarker marker{ids[i], size_m, Eigen::Isometry3d::Identity()};
    marker.T_tool_marker.translation() << (column - 0.5 * (columns - 1)) * pitch_x,
        (0.5 * (rows - 1) - row) * pitch_y, 0.0;
    board.tool.markers.push_back(marker);
  }
  return board;
}

MarkerBoard layOutSheet(const std::string& dictionary, std::vector<int> ids, double size_m,
                        const std::string& paper) {
  MarkerBoard sheet = boardPaper(paper);
  if (size_m == 0.0) size_m = usualSheetMarker(sheet);
  checkSize(size_m);
  if (ids.empty()) checkIds(dictionary, {kFirstSheetId});
  const double margin = size_m / markerCells(dictionary, ids.empty() ? kFirstSheetId : ids.front()).cols;
  const std::vector<double> across = placesInRow(sheet.paper_width_m, size_m, margin),
                            up = placesInRow(sheet.paper_height_m, size_m, margin);
  const double taken = 2.0 * (kEdge_m + size_m + margin);
  sheet.free_width_m = sheet.paper_width_m - taken;
  sheet.free_height_m = sheet.paper_height_m - taken;
  if (across.empty() || up.empty() || sheet.free_width_m < size_m)
    throw std::invalid_argument(
        fmt::format("a ring of markers of {:g} mm leaves no free middle on {} paper", 1e3 * size_m, paper));
  const std::vector<Eigen::Vector2d> ring = ringOf(across, up);
  if (ids.empty()) {
    ids.resize(ring.size());
    std::iota(ids.begin(), ids.end(), kFirstSheetId);
  }
  if (ids.size() != ring.size())
    throw std::invalid_argument(
        fmt::format("{} marker ids are given; a ring of markers of {:g} mm on {} paper has {}", ids.size(),
                    1e3 * size_m, paper, ring.size()));
  checkIds(dictionary, ids);
  sheet.tool.dictionary = dictionary;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ToolMarker marker{ids[i], size_m, Eigen::Isometry3d::Identity()};
    marker.T_tool_marker.translation() << ring[i], 0.0;
    sheet.tool.markers.push_back(marker);
  }
  return sheet;
}

std::string boardYaml(const MarkerBoard& board) {
  const bool sheet = board.free_width_m > 0.0;
  std::string yaml = "# Tool frame: origin at the centre of the sheet, x right, y up, z out of the print.";
  yaml += sheet ? "\n# A ring of markers around a free middle: put the object there and walk around it with "
                  "the camera.\n"
                : " Set the pose of each\n"
                  "# marker on your tool. Add the blade's corners in the tool frame [m]:\n"
                  "#   blade: [[x, y, z], [x, y, z], [x, y, z], [x, y, z]]\n";
  yaml += fmt::format("tool:\n  dictionary: {}\n  markers:\n", board.tool.dictionary);
  for (const ToolMarker& marker : board.tool.markers) {
    const Eigen::Vector3d at = marker.T_tool_marker.translation();
    yaml += fmt::format("    - {{id: {}, size_m: {:g}, pose: [{:.6g}, {:.6g}, 0, 0, 0, 0, 1]}}\n", marker.id,
                        marker.size_m, at.x(), at.y());
  }
  return yaml;
}

}  // namespace softbody
