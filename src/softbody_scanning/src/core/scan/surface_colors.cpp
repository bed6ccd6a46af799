#include "scan/surface_colors.h"

#include <cmath>

namespace softbody::scanning {
namespace {

constexpr double kSigmas = 3.0;  // a place that is hidden differs from the measured depth by more

}  // namespace

Points surfaceColors(const TriangleMesh& mesh, const std::vector<DepthView>& views,
                     const std::vector<KeyFrame>& frames, double inverse_depth_std) {
  Points colors = Points::Zero(mesh.vertices.rows(), 3);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(mesh.vertices.rows());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const DepthView& view = views[i];
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      const Eigen::Vector3d p = view.T_camera_model * Eigen::Vector3d(mesh.vertices.row(v));
      if (!(p.z() > 0.05)) continue;
      const Eigen::Vector2d pixel = view.camera.project(p);
      if (!view.camera.contains(pixel.x(), pixel.y())) continue;
      const int column = static_cast<int>(std::lround(pixel.x())),
                row = static_cast<int>(std::lround(pixel.y()));
      const double z = view.depth(row, column);
      const cv::Vec3f& plane = view.plane(row, column);
      if (plane[2] == 0.0f || std::abs(1.0 / z - 1.0 / p.z()) > kSigmas * inverse_depth_std) continue;
      const double cosine = 1.0 / (cv::norm(plane) * p.norm());
      const cv::Vec3b& color = frames[i].color(row, column);
      colors.row(v) += cosine * Eigen::RowVector3d(color[0], color[1], color[2]);
      weights[v] += cosine;
    }
  }
  const Eigen::RowVector3d mean = colors.colwise().sum() / std::max(weights.sum(), 1e-9);
  for (Eigen::Index v = 0; v < colors.rows(); ++v)
    colors.row(v) = weights[v] > 0.0 ? Eigen::RowVector3d(colors.row(v) / weights[v]) : mean;
  return colors;
}

}  // namespace softbody::scanning
