#include "agreement/body_edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {
namespace {

// Smallest step of depth that is an edge, in distance scales and in thicknesses of the body.
constexpr double kLeastStep = 0.25;

/// Whether depth runs straight on across an outline. On a plane the inverse depth is linear in the pixel. An
/// edge counts within the smallest step of the outline: a bent body's outline is not exactly the mesh's.
/// @param pixel the last one inside. @param step from inside to outside. @param least_step_m at 1 m.
bool runsOn(const RgbdFrame& frame, const cv::Point& pixel, const cv::Point& step, double least_step_m) {
  const cv::Mat1f& depth = frame.depth;
  const double inner = depth(pixel - 3 * step), edge = depth(pixel - step);
  if (!(inner > 0.0 && edge > 0.0)) return false;
  const cv::Rect image({}, depth.size());
  const int reach = std::max(2, cvRound(distanceScaleAt(edge, least_step_m) * frame.camera.fx / edge));
  for (int k = 2; k <= reach && image.contains(pixel + k * step); ++k) {
    const double beyond = depth(pixel + k * step);
    const double expected = 1.0 / (1.0 / edge + 0.5 * (k + 1) * (1.0 / edge - 1.0 / inner));
    if (beyond > 0.0 && std::abs(beyond - expected) >= distanceScaleAt(beyond, least_step_m)) return false;
  }
  return true;
}

}  // namespace

double thicknessOf(const Points& vertices) {
  const Eigen::RowVector3d center = vertices.colwise().mean();
  const Points arms = vertices.rowwise() - center;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(arms.transpose() * arms);
  const Points along = arms * axes.eigenvectors();
  return (along.colwise().maxCoeff() - along.colwise().minCoeff()).minCoeff();
}

double shareWithoutEdge(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  static const cv::Point kSteps[4] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  RasterImage image;
  rasterize(small.camera, transformed(mesh.vertices, pose), mesh.triangles, &image);
  const auto shows = [&](const cv::Point& pixel) { return image.triangle(pixel) >= 0; };
  const double least_step_m = kLeastStep * std::min(kDistanceScale_m, thicknessOf(mesh.vertices));
  const cv::Rect region = image.region & cv::Rect(3, 3, image.depth.cols - 6, image.depth.rows - 6);
  int outline = 0, without = 0;
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) {
      const cv::Point pixel(u, v);
      for (const cv::Point& step : kSteps) {
        const cv::Point beyond = pixel + 2 * step;
        if (!shows(pixel) || !shows(pixel - 3 * step) || shows(pixel + step) || shows(beyond)) continue;
        if (!(small.depth(beyond) > 0.0f)) continue;
        ++outline;
        without += runsOn(small, pixel, step, least_step_m) ? 1 : 0;
      }
    }
  }
  return outline == 0 ? 0.0 : static_cast<double>(without) / outline;
}

}  // namespace softbody
