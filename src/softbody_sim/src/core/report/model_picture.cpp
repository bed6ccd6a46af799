#include "report/model_picture.h"

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/drawing/mesh_drawing.h"

namespace softbody {
namespace {

const cv::Size kSize(560, 480);

/// Boundary of the tets beyond the middle, as seen by the camera.
Triangles farHalf(const TetTopology& volume, const Eigen::Isometry3d& T_camera_mesh) {
  std::vector<double> depths;
  for (const auto& tet : volume.tets.rowwise()) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int v : tet) sum += volume.rest_vertices.row(v).transpose();
    depths.push_back((T_camera_mesh * (0.25 * sum)).z());
  }
  const double middle = medianOf(depths);
  std::vector<Eigen::Index> far;
  for (std::size_t t = 0; t < depths.size(); ++t) {
    if (depths[t] >= middle) far.push_back(static_cast<Eigen::Index>(t));
  }
  return boundaryTriangles(Tets(volume.tets(far, Eigen::all)));
}

}  // namespace

cv::Mat3b drawModel(const ObjectModel& model) {
  const Points& rest = model.volume.rest_vertices;
  const View view = viewOf(rest, kSize);
  const auto draw = [&view](const Points& vertices, const Triangles& triangles, const cv::Vec3d& color,
                            bool edges) {
    return drawMesh(vertices, triangles, {{color}, edges, {}, {}}, view);
  };
  const cv::Mat3b parts[] = {draw(model.visual.rest_vertices, model.visual.triangles, {120, 190, 235}, false),
                             draw(rest, model.volume.surface, {225, 190, 140}, true),
                             draw(rest, farHalf(model.volume, view.T_camera_mesh), {150, 210, 150}, true)};
  cv::Mat3b picture;
  cv::hconcat(parts, 3, picture);
  return picture;
}

}  // namespace softbody
