#include "scanned/desk.h"

#include <Eigen/Dense>
#include <cmath>

#include "cluttered/draws.h"
#include "softbody_common/statistics/random.h"
#include "softbody_tracking/tool/marker_detector.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

/// A rectangle of squares. Triangles that reach behind the camera are not drawn, so they must be small.
TriangleMesh squares(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u,
                     const Eigen::Vector3d& edge_v, double side_m) {
  const int columns = static_cast<int>(std::ceil(edge_u.norm() / side_m)),
            rows = static_cast<int>(std::ceil(edge_v.norm() / side_m));
  TriangleMesh mesh{Points((columns + 1) * (rows + 1), 3), Triangles(2 * columns * rows, 3)};
  Eigen::Index vertex = 0, triangle = 0;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i)
      mesh.vertices.row(vertex++) = corner + edge_u * i / columns + edge_v * j / rows;
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, c = a + columns + 1;
      mesh.triangles.row(triangle++) << a, a + 1, c + 1;
      mesh.triangles.row(triangle++) << a, c + 1, c;
    }
  }
  return mesh;
}

/// Books, boxes and cans, so low that they hide nothing of the body.
TriangleMesh placedThings(double scale, double table_z, std::uint64_t seed) {
  constexpr int kCount = 9;
  Draws draws(seed);
  std::vector<TriangleMesh> things;
  for (int i = 0; i < kCount; ++i) {
    const double height = draws.between(0.02, 0.05), away = draws.between(0.34, 0.62);
    TriangleMesh thing = i % 3 == 2 ? cylinder(draws.between(0.025, 0.04), height)
                                    : box({draws.between(0.07, 0.16), draws.between(0.05, 0.11), height});
    thing.vertices *= scale;
    const double azimuth = 2.0 * M_PI * (i + draws.between(-0.25, 0.25)) / kCount;
    const Eigen::Vector3d place(scale * away * std::cos(azimuth), scale * away * std::sin(azimuth),
                                table_z + 0.5 * scale * height);
    thing.vertices = transformed(
        Eigen::Translation3d(place) * Eigen::AngleAxisd(draws.between(0.0, 3.0), Eigen::Vector3d::UnitZ()),
        thing.vertices);
    things.push_back(thing);
  }
  return merge(things);
}

/// Brightness of the print.
float inked(const std::vector<std::pair<Eigen::Isometry3d, cv::Mat1b>>& markers,
            const std::vector<double>& sizes_m, const Eigen::Vector3d& place) {
  constexpr float kWhite = 0.92f, kBlack = 0.06f;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const auto& [T_marker_sheet, cells] = markers[i];
    const Eigen::Vector3d p = T_marker_sheet * place / sizes_m[i];
    const int column = static_cast<int>(std::floor((p.x() + 0.5) * cells.cols)),
              row = static_cast<int>(std::floor((0.5 - p.y()) * cells.rows));
    if (column < 0 || column >= cells.cols || row < 0 || row >= cells.rows) continue;
    return cells(row, column) > 127 ? kWhite : kBlack;
  }
  return kWhite;
}

constexpr double kSheetTexel = 0.3e-3;  // [m]

/// The edges of the cells are smoothed over one texel.
Texture printTexture(const ToolDescription& sheet) {
  std::vector<std::pair<Eigen::Isometry3d, cv::Mat1b>> markers;
  std::vector<double> sizes_m;
  for (const auto& marker : sheet.markers) {
    markers.emplace_back(marker.T_tool_marker.inverse(), markerCells(sheet.dictionary, marker.id));
    sizes_m.push_back(marker.size_m);
  }
  return [=](const Eigen::Vector3d& place) -> Eigen::Vector3f {
    constexpr double kQuarter = 0.25 * kSheetTexel;
    float sum = 0.0f;
    for (const double dx : {-kQuarter, kQuarter}) {
      for (const double dy : {-kQuarter, kQuarter})
        sum += inked(markers, sizes_m, place + Eigen::Vector3d(dx, dy, 0.0));
    }
    return Eigen::Vector3f::Constant(0.25f * sum);
  };
}

}  // namespace

std::vector<Actor> deskActors(double scale, double table_z, const ContactShadow* shadow, std::uint64_t seed) {
  const double half = 1.5 * scale, high = 1.5 * scale, square = 0.15 * scale;
  const Eigen::Vector3d corner(-half, -half, table_z), x(2.0 * half, 0.0, 0.0), y(0.0, 2.0 * half, 0.0),
      up(0.0, 0.0, high);
  const TriangleMesh walls =
      merge({squares(corner, up, x, 0.5 * scale), squares(corner, y, up, 0.5 * scale),
             squares(corner + x, up, y, 0.5 * scale), squares(corner + y, x, up, 0.5 * scale)});
  const Texture wood = woodTexture(hash(seed, 2));
  std::vector<Actor> actors = {
      {squares(corner, x, y, square), shadow ? shadow->on(wood) : wood, 2.4e-3 * scale},
      {walls, plasterTexture(hash(seed, 3)), 10.0e-3 * scale},
      {placedThings(scale, table_z, hash(seed, 4)), cellTexture(hash(seed, 5)), 1.2e-3 * scale}};
  for (Actor& actor : actors) actor.background = true;
  return actors;
}

Actor sheetActor(const ToolDescription& sheet, const ContactShadow& shadow) {
  constexpr double kEdge = 0.010, kSquare = 0.04;  // [m] paper beyond the markers
  Eigen::Vector2d half = Eigen::Vector2d::Zero();
  for (const auto& marker : sheet.markers)
    half = half.cwiseMax(markerCorners(marker).topRows<2>().cwiseAbs().rowwise().maxCoeff());
  half = sheet.markers.empty() ? Eigen::Vector2d(0.105, 0.1485) : Eigen::Vector2d(half.array() + kEdge);
  Actor actor{
      squares({-half.x(), -half.y(), 0.0}, {2.0 * half.x(), 0.0, 0.0}, {0.0, 2.0 * half.y(), 0.0}, kSquare),
      shadow.on(printTexture(sheet)), kSheetTexel};
  actor.background = true;
  return actor;
}

}  // namespace softbody::virtual_camera
