#include "scanned/contact_shadow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody::virtual_camera {
namespace {

constexpr int kCells = 96;          // of the longer side
constexpr double kBeside = 0.25;    // of the body's length: how far the shadow can reach
constexpr double kReach = 0.1;      // of the body's length: height above which it takes half of the light
constexpr float kDarkest = 0.55f;   // share of the light that is taken at a contact
constexpr double kSoftCells = 2.5;  // penumbra

}  // namespace

ContactShadow::ContactShadow(const TriangleMesh& body) {
  const Eigen::RowVector3d low = body.vertices.colwise().minCoeff(),
                           high = body.vertices.colwise().maxCoeff();
  const double length = (high - low).head<2>().maxCoeff(), cell_m = (1.0 + 2.0 * kBeside) * length / kCells;
  corner_ = (0.5 * (low + high)).head<2>().transpose().array() - 0.5 * (kCells - 1) * cell_m;
  cell_m_ = cell_m;
  cv::Mat1f taken(kCells, kCells, 0.0f);
  for (Eigen::Index f = 0; f < body.triangles.rows(); ++f) {
    const Eigen::RowVector3d a = body.vertices.row(body.triangles(f, 0)),
                             u = body.vertices.row(body.triangles(f, 1)) - a,
                             v = body.vertices.row(body.triangles(f, 2)) - a;
    const int steps = 1 + static_cast<int>(2.0 * std::max(u.norm(), v.norm()) / cell_m);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Eigen::RowVector3d p = a + (u * i + v * j) / steps;
        const Eigen::Vector2d at = (p.head<2>().transpose() - corner_) / cell_m;
        float& cell = taken(static_cast<int>(std::lround(at.y())), static_cast<int>(std::lround(at.x())));
        cell = std::max(cell, kDarkest / static_cast<float>(1.0 + p.z() / (kReach * length)));
      }
    }
  }
  cv::GaussianBlur(taken, taken, {}, kSoftCells);
  light_ = 1.0f - taken;
}

float ContactShadow::lightAt(const Eigen::Vector3d& place) const {
  const Eigen::Vector2d at = (place.head<2>() - corner_) / cell_m_;
  if (!(at.minCoeff() >= 0.0 && at.maxCoeff() < kCells - 1)) return 1.0f;
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  const float s = static_cast<float>(at.x() - x), t = static_cast<float>(at.y() - y);
  return (1 - t) * ((1 - s) * light_(y, x) + s * light_(y, x + 1)) +
         t * ((1 - s) * light_(y + 1, x) + s * light_(y + 1, x + 1));
}

Texture ContactShadow::on(const Texture& texture) const {
  return [shadow = *this, texture](const Eigen::Vector3d& place) -> Eigen::Vector3f {
    return shadow.lightAt(place) * texture(place);
  };
}

}  // namespace softbody::virtual_camera
