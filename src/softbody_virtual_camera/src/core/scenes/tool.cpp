#include "scenes/tool.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_tracking/tool/marker_detector.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr int kCells = 6;  // 4 bits, and a black border on both sides

ToolMarker readMarker(const YAML::Node& node) {
  ToolMarker marker;
  marker.id = node["id"].as<int>();
  marker.size_m = node["size_m"].as<double>();
  const auto p = node["pose"].as<std::vector<double>>();
  if (marker.id < 0 || marker.id >= 50) throw std::range_error("marker ids are 0 to 49");
  if (!(marker.size_m > 0.0)) throw std::range_error("size_m must be above 0");
  if (p.size() != 7) throw std::range_error("pose needs seven numbers");
  marker.T_tool_marker =
      Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(p[6], p[3], p[4], p[5]).normalized();
  return marker;
}

Points readBlade(const YAML::Node& node) {
  const auto corners = node.as<std::vector<std::vector<double>>>();
  if (corners.size() < 3) throw std::range_error("blade needs three corners or more");
  Points blade(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i].size() != 3) throw std::range_error("a corner of the blade needs three numbers");
    blade.row(static_cast<Eigen::Index>(i)) << corners[i][0], corners[i][1], corners[i][2];
  }
  return blade;
}

/// Black cells on white, in the plane of the marker. The edges are smoothed over one texel.
Texture markerTexture(const ToolMarker& marker) {
  constexpr double kQuarterTexel = 0.1e-3;  // [m]
  const cv::Mat1b cells = markerCells("DICT_4X4_50", marker.id);
  const auto level = [=](const Eigen::Vector3d& place) {
    const Eigen::Vector3d p = place / marker.size_m;
    const int column = static_cast<int>(std::floor((p.x() + 0.5) * kCells)),
              row = static_cast<int>(std::floor((0.5 - p.y()) * kCells));
    const bool outside = column < 0 || column >= kCells || row < 0 || row >= kCells;
    return outside || cells(row, column) > 127 ? 0.92f : 0.06f;
  };
  return
      [=, T_marker_tool = marker.T_tool_marker.inverse()](const Eigen::Vector3d& place) -> Eigen::Vector3f {
        float sum = 0.0f;
        for (const double dx : {-kQuarterTexel, kQuarterTexel}) {
          for (const double dy : {-kQuarterTexel, kQuarterTexel})
            sum += level(T_marker_tool * place + Eigen::Vector3d(dx, dy, 0.0));
        }
        return Eigen::Vector3f::Constant(0.25f * sum);
      };
}

TriangleMesh plate(const ToolMarker& marker) {
  const double size = 1.4 * marker.size_m;  // with a white margin larger than a cell
  const Eigen::Isometry3d& T = marker.T_tool_marker;
  const Eigen::Vector3d x = size * T.linear().col(0), y = size * T.linear().col(1);
  return rectangle(T.translation() - 0.5 * (x + y), x, y);
}

/// Both sides of a convex polygon, half a millimetre apart.
TriangleMesh sheet(const Points& polygon) {
  const int n = static_cast<int>(polygon.rows());
  const Eigen::Vector3d a = polygon.row(0), b = polygon.row(1), c = polygon.row(2);
  const Eigen::RowVector3d half = 0.25e-3 * (b - a).cross(c - a).normalized().transpose();
  TriangleMesh mesh{Points(2 * n, 3), Triangles(2 * (n - 2), 3)};
  mesh.vertices << polygon.rowwise() + half, polygon.rowwise() - half;
  for (int k = 2; k < n; ++k) {
    mesh.triangles.row(2 * k - 4) << 0, k - 1, k;
    mesh.triangles.row(2 * k - 3) << n, n + k, n + k - 1;
  }
  return mesh;
}

}  // namespace

Tool readTool(const std::string& path) {
  try {
    const YAML::Node node = parseYamlFile(path)["tool"];
    if (node["dictionary"].as<std::string>() != "DICT_4X4_50") {
      throw std::range_error("the virtual camera draws markers of DICT_4X4_50 only");
    }
    Tool tool;
    for (const YAML::Node& marker : node["markers"]) tool.markers.push_back(readMarker(marker));
    tool.blade = readBlade(node["blade"]);
    return tool;
  } catch (const std::exception& error) {
    throw std::invalid_argument(fmt::format("{}: {}", path, error.what()));
  }
}

Tool scaled(const Tool& tool, double factor) {
  Tool result = tool;
  result.blade *= factor;
  for (ToolMarker& marker : result.markers) {
    marker.size_m *= factor;
    marker.T_tool_marker.translation() *= factor;
  }
  return result;
}

std::vector<Actor> toolActors(const Tool& tool) {
  const Texture steel = [](const Eigen::Vector3d&) { return Eigen::Vector3f(0.72f, 0.74f, 0.77f); };
  const Eigen::Vector3d middle = tool.blade.colwise().mean().transpose();
  std::vector<Actor> actors = {
      {merge({sheet(tool.blade), capsule(0.1 * middle, 0.8 * middle, 0.005)}), steel, 4e-3}};
  for (const ToolMarker& marker : tool.markers) actors.push_back({plate(marker), markerTexture(marker)});
  return actors;
}

}  // namespace softbody::virtual_camera
