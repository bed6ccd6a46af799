#include "ros/cut_markers.h"

#include <array>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidth = 0.0012, kPreviewLineWidth = 0.002;  // [m]
constexpr double kLifetime = 1.0;                                 // of preview markers [s]
constexpr double kLift = 0.005;  // of a preview above the surface, relative to the body's size

/// Colours that colour-blind people can distinguish (Okabe and Ito 2008).
Eigen::Vector3f pieceColor(std::uint32_t piece) {
  static const std::array<Eigen::Vector3f, 6> colors{{{0.34f, 0.71f, 0.91f},
                                                      {0.90f, 0.62f, 0.00f},
                                                      {0.00f, 0.62f, 0.45f},
                                                      {0.80f, 0.47f, 0.65f},
                                                      {0.94f, 0.89f, 0.26f},
                                                      {0.00f, 0.45f, 0.70f}}};
  return colors[piece % colors.size()];
}

Marker makeMarker(const char* name, std::int32_t type, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0f;
  return marker;
}

Marker makeLines(const char* name, const Edges& lines, const Points& vertices, double width,
                 const Eigen::Vector3f& rgb, const std_msgs::Header& header) {
  Marker marker = makeMarker(name, Marker::LINE_LIST, header);
  if (lines.rows() == 0) marker.action = Marker::DELETE;
  marker.scale.x = width;
  marker.color = colorMessage(rgb);
  for (const int vertex : lines.reshaped<Eigen::RowMajor>())
    marker.points.push_back(pointMessage(vertices.row(vertex)));
  return marker;
}

/// Two-sided light of a lamp at the frame's origin: rviz does not light coloured triangles.
Eigen::Vector3f shaded(const Eigen::Vector3f& rgb, const Eigen::Vector3d& position,
                       const Eigen::Vector3d& normal) {
  return static_cast<float>(0.35 + 0.65 * std::abs(normal.dot(position.normalized()))) * rgb;
}

}  // namespace

Marker makeCutLinesMarker(const Edges& lines, const Points& vertices, const std_msgs::Header& header) {
  return makeLines("cut_lines", lines, vertices, kLineWidth, {0.85f, 0.05f, 0.05f}, header);
}

visualization_msgs::MarkerArray makePreviewMarkers(const MeshTopology& pieces, const Edges& lines,
                                                   const Points& vertices, const std_msgs::Header& header) {
  const double size = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
  const Points normals = vertexNormals(vertices, pieces.triangles);
  const Points lifted = vertices + kLift * size * normals;
  Marker skin = makeMarker("pieces", Marker::TRIANGLE_LIST, header);
  skin.scale.x = skin.scale.y = skin.scale.z = 1.0;
  for (Eigen::Index t = 0; t < pieces.triangles.rows(); ++t) {
    const Eigen::Vector3f color = pieceColor(pieces.triangle_pieces[static_cast<std::size_t>(t)]);
    for (const int vertex : pieces.triangles.row(t)) {
      skin.points.push_back(pointMessage(lifted.row(vertex)));
      skin.colors.push_back(colorMessage(shaded(color, lifted.row(vertex), normals.row(vertex))));
    }
  }
  visualization_msgs::MarkerArray message;
  message.markers = {skin, makeLines("lines", lines, lifted, kPreviewLineWidth, {1.0f, 0.1f, 0.1f}, header)};
  for (Marker& marker : message.markers) marker.lifetime = ros::Duration(kLifetime);
  return message;
}

visualization_msgs::MarkerArray endOfPreview(const std_msgs::Header& header) {
  visualization_msgs::MarkerArray message;
  message.markers = {makeMarker("", Marker::TRIANGLE_LIST, header)};
  message.markers.front().action = Marker::DELETEALL;
  return message;
}

}  // namespace softbody
