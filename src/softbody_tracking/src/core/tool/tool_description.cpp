#include "softbody_tracking/tool/tool_description.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "softbody_common/cutting/blade.h"
#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

constexpr double kMinMarker_m = 0.001;  // [m] smallest side of a marker

std::string readDictionary(YamlMapReader& tool, FileScope scope) {
  std::string name = tool.text("dictionary");
  const auto names = dictionaryNames();
  if (std::find(names.begin(), names.end(), name) != names.end()) return name;
  if (name.find('.') == std::string::npos) {
    tool.fail(tool.get("dictionary"),
              fmt::format("tool/dictionary is '{}'; allowed: {}, or a file in OpenCV's format", name,
                          fmt::join(names, ", ")));
  }
  return tool.file("dictionary", scope);
}

ToolMarker readMarker(YamlMapReader& reader, int count) {
  ToolMarker marker;
  marker.id = reader.requiredInteger("id", 0, count - 1);
  marker.size_m = reader.requiredNumber("size_m", kMinMarker_m, kLargestTool_m);
  if (reader.has("pose")) marker.T_tool_marker = reader.pose("pose");
  return marker;
}

void readMarkers(YamlMapReader& tool, const std::string& path, ToolDescription* description) {
  const YAML::Node list = tool.get("markers");
  if (!list.IsDefined() || !list.IsSequence() || list.size() == 0)
    tool.fail(list, "tool/markers must be a list of at least one {id, size_m, pose}");
  const int count = markersInDictionary(description->dictionary);
  std::set<int> ids;
  for (std::size_t i = 0; i < list.size(); ++i) {
    YamlMapReader reader(list[i], path, fmt::format("tool/markers[{}]/", i));
    description->markers.push_back(readMarker(reader, count));
    reader.warnOfUnknown(&description->warnings);
    const int id = description->markers.back().id;
    if (!ids.insert(id).second)
      tool.fail(list[i],
                fmt::format("tool/markers[{}]/id is {}, which another marker has; ids must differ", i, id));
  }
}

/// The frame, or else the markers.
void readPlace(YamlMapReader& tool, const std::string& path, FileScope scope, ToolDescription* description) {
  description->frame = tool.text("frame");
  if (description->frame.empty()) {
    description->dictionary = readDictionary(tool, scope);
    return readMarkers(tool, path, description);
  }
  if (tool.has("markers"))
    tool.fail(tool.get("markers"), "tool has a frame and markers; allowed: a frame of tf, or markers");
}

Points readBlade(YamlMapReader& tool) {
  const YAML::Node list = tool.get("blade");
  if (!list.IsDefined()) return Points(0, 3);
  if (!list.IsSequence() || list.size() < 3 || list.size() > kMostBladeCorners)
    tool.fail(list,
              fmt::format("tool/blade must be a list of three to {} corners [x, y, z]", kMostBladeCorners));
  Points blade(static_cast<Eigen::Index>(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<double> corner;
    try {
      corner = list[i].as<std::vector<double>>();
    } catch (const YAML::Exception&) {
    }
    const bool usable = corner.size() == 3 &&
                        std::all_of(corner.begin(), corner.end(), [](double x) { return std::isfinite(x); });
    if (!usable) {
      tool.fail(list[i], fmt::format("tool/blade[{}] is '{}'; allowed: three numbers [m]", i,
                                     YamlMapReader::shown(list[i])));
    }
    blade.row(static_cast<Eigen::Index>(i)) << corner[0], corner[1], corner[2];
  }
  return blade;
}

void checkSize(YamlMapReader& tool, const ToolDescription& description) {
  Eigen::AlignedBox3d box;
  const auto check = [&](const std::string& key) {
    const double span = box.isEmpty() ? 0.0 : box.diagonal().norm();
    if (span <= kLargestTool_m) return;
    tool.fail(tool.get(key),
              fmt::format("with tool/{} the tool spans {:.4g} m; allowed: up to {} m; lengths are in metres",
                          key, span, kLargestTool_m));
  };
  for (const auto& corner : description.blade.rowwise()) box.extend(corner.transpose());
  check("blade");
  for (const ToolMarker& marker : description.markers) {
    const Eigen::Matrix<double, 3, 4> corners = markerCorners(marker);
    for (int k = 0; k < 4; ++k) box.extend(corners.col(k));
  }
  check("markers");
}

}  // namespace

ToolDescription loadToolDescription(const std::string& yaml_path, FileScope scope) {
  YamlMapReader file(parseYamlFile(yaml_path), yaml_path, "");
  YamlMapReader tool = file.map("tool");
  ToolDescription description;
  readPlace(tool, yaml_path, scope, &description);
  description.blade = readBlade(tool);
  checkSize(tool, description);
  if (description.blade.rows() > 0) {
    const std::string fault = bladeFault(description.blade);
    if (!fault.empty()) tool.fail(tool.get("blade"), "tool/blade " + fault);
  }
  tool.warnOfUnknown(&description.warnings);
  file.warnOfUnknown(&description.warnings);
  return description;
}

ToolDescription loadToolWithMarkers(const std::string& yaml_path, FileScope scope) {
  ToolDescription description = loadToolDescription(yaml_path, scope);
  if (description.markers.empty())
    throw std::invalid_argument(
        fmt::format("{}: tool/frame is '{}', so the tool has no markers; give tool/markers instead",
                    yaml_path, description.frame));
  return description;
}

ToolDescription inFrame(ToolDescription tool, const std::string& frame) {
  if (frame.empty()) return tool;
  tool.frame = frame;
  tool.markers.clear();
  tool.dictionary.clear();
  return tool;
}

Eigen::Matrix<double, 3, 4> markerCorners(const ToolMarker& marker) {
  const double h = 0.5 * marker.size_m;
  Eigen::Matrix<double, 3, 4> corners;
  corners << -h, h, h, -h, h, h, -h, -h, 0.0, 0.0, 0.0, 0.0;
  return marker.T_tool_marker * corners;
}

}  // namespace softbody
