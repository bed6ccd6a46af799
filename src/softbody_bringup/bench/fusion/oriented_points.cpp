#include "bench/fusion/oriented_points.h"

#include <Eigen/Dense>
#include <cmath>
#include <unordered_map>

namespace softbody::scanning {
namespace {

struct Mean {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double weight = 0.0;
};

/// The cells of a grid.
struct Cells {
  Eigen::AlignedBox3d box;
  double size_m = 0.0;
  std::unordered_map<std::size_t, Mean> means;
};

std::size_t keyOf(const Cells& cells, const Eigen::Vector3d& place) {
  const Eigen::Vector3d index = (place - cells.box.min()) / cells.size_m;
  std::size_t key = 0;
  for (int k = 0; k < 3; ++k) key = key << 20 | static_cast<std::size_t>(index[k]);
  return key;
}

void addView(const DepthView& view, const Eigen::Hyperplane<double, 3>& table, double clear_m, Cells* cells) {
  const Eigen::Isometry3d T_model_camera = view.T_camera_model.inverse();
  for (int v = 0; v < view.depth.rows; ++v) {
    for (int u = 0; u < view.depth.cols; ++u) {
      const Eigen::Vector3d plane =
          Eigen::Map<const Eigen::Vector3f>(view.plane(v, u).val).cast<double>();  // N . p = 1
      if (plane.isZero()) continue;
      const Eigen::Vector3d ray = view.camera.unproject(u, v, 1.0);
      const double z = 1.0 / plane.dot(ray);
      const Eigen::Vector3d place = T_model_camera * (z * ray);
      if (!(z > 0.0) || !cells->box.contains(place) || table.signedDistance(place) < clear_m) continue;
      const Eigen::Vector3d normal = -(T_model_camera.linear() * plane.normalized());
      const double cosine = 1.0 / (plane.norm() * z * ray.norm()), weight = cosine / (z * z * z * z);
      Mean& mean = cells->means[keyOf(*cells, place)];
      mean.position += weight * place;
      mean.normal += weight * normal;
      mean.weight += weight;
    }
  }
}

}  // namespace

OrientedPoints orientedPoints(const std::vector<RecordedSide>& sides, const FusionBox& box, double spacing_m,
                              double clear_m) {
  Cells cells{box.box, spacing_m, {}};
  for (const RecordedSide& side : sides)
    for (const DepthView& view : side.views) addView(view, side.table, clear_m, &cells);
  OrientedPoints points;
  points.positions.resize(static_cast<Eigen::Index>(cells.means.size()), 3);
  points.normals.resize(points.positions.rows(), 3);
  Eigen::Index row = 0;
  for (const auto& [key, mean] : cells.means) {
    points.positions.row(row) = mean.position.transpose() / mean.weight;
    points.normals.row(row++) = mean.normal.normalized().transpose();
  }
  return points;
}

}  // namespace softbody::scanning
