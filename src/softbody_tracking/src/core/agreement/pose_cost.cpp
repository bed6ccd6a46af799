#include "agreement/pose_cost.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

/// How badly a depth agrees, from 0 to 1 at a distance scale.
double misfit(double measured, double predicted, double scale) {
  const double ratio = (measured - predicted) / distanceScaleAt(predicted, scale);
  return std::min(1.0, ratio * ratio);
}

double pixelCost(double measured, double predicted, double scale, double hidden_cost) {
  if (!(measured > 0.0)) return kUnseenCost;
  const double cost = misfit(measured, predicted, scale);
  return measured < predicted ? std::min(hidden_cost, cost) : cost;
}

/// Pixels just outside the rendered outline.
struct Outline {
  int measured = 0;         ///< with depth
  double continuing = 0.0;  ///< sum of how well their depth continues the surface, 0..1 each
};

Outline outlineOf(const RgbdFrame& frame, const RasterImage& image, double scale) {
  const cv::Rect inner(2, 2, image.depth.cols - 4, image.depth.rows - 4);
  const cv::Rect region = image.region & inner;
  const auto stride = static_cast<std::ptrdiff_t>(image.triangle.step1()),
             measured_stride = static_cast<std::ptrdiff_t>(frame.depth.step1());
  Outline outline;
  for (int v = region.y; v < region.br().y; ++v) {
    const int* triangle = image.triangle[v];
    const float *rendered = image.depth[v], *measured = frame.depth[v];
    const auto lookBeyond = [&](int u, std::ptrdiff_t step, std::ptrdiff_t measured_step) {
      if (triangle[u + step] >= 0 || triangle[u + 2 * step] >= 0) return;
      const float z = measured[u + 2 * measured_step];
      if (!(z > 0.0f)) return;
      ++outline.measured;
      outline.continuing += 1.0 - misfit(z, rendered[u], scale);
    };
    for (int u = region.x; u < region.br().x; ++u) {
      if (triangle[u] < 0) continue;
      lookBeyond(u, 1, 1);
      lookBeyond(u, -1, -1);
      lookBeyond(u, stride, measured_stride);
      lookBeyond(u, -stride, -measured_stride);
    }
  }
  return outline;
}

double renderedCost(const RgbdFrame& frame, const RasterImage& image, double scale, double hidden_cost) {
  double sum = 0.0;
  int covered = 0;
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    const int* triangle = image.triangle[v];
    const float *rendered = image.depth[v], *measured = frame.depth[v];
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      if (triangle[u] < 0) continue;
      ++covered;
      sum += pixelCost(measured[u], rendered[u], scale, hidden_cost);
    }
  }
  if (covered == 0) return 1.0;
  return (sum + kOtherObject * outlineOf(frame, image, scale).continuing) / covered;
}

}  // namespace

PoseCost::PoseCost(const RgbdFrame& frame, const TriangleMesh& mesh, double hidden_cost, double scale)
    : frame_(frame),
      mesh_(mesh),
      scale_(scale),
      hidden_cost_(hidden_cost),
      faces_(isClosed(mesh.triangles) ? Faces::kFront : Faces::kAll) {}

PoseCost::PoseCost(const PoseCost& other)
    : frame_(other.frame_),
      mesh_(other.mesh_),
      scale_(other.scale_),
      hidden_cost_(other.hidden_cost_),
      faces_(other.faces_) {}

const RasterImage& PoseCost::render(const Points& vertices) {
  rasterize(frame_.camera, vertices, mesh_.triangles, &image_, faces_);
  return image_;
}

const RasterImage& PoseCost::render(const Eigen::Isometry3d& pose) {
  return render(transformed(mesh_.vertices, pose));
}

double PoseCost::operator()(const Eigen::Isometry3d& pose) {
  return renderedCost(frame_, render(pose), scale_, hidden_cost_);
}

PoseAgreement PoseCost::agreement(const Eigen::Isometry3d& pose) {
  const RasterImage& image = render(pose);
  PoseAgreement counts;
  std::vector<double> differences;
  double misfits = 0.0;
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      if (image.triangle(v, u) < 0) continue;
      ++counts.covered;
      const double measured = frame_.depth(v, u), difference = measured - image.depth(v, u);
      const double cost = measured > 0.0 ? misfit(measured, image.depth(v, u), scale_) : kUnseenCost;
      const bool hidden = measured > 0.0 && difference < 0.0 && cost >= 1.0;
      if (!hidden) misfits += cost;
      if (!(measured > 0.0)) continue;
      differences.push_back(std::abs(difference));
      if (cost < 1.0)
        ++counts.agreeing;
      else
        ++(hidden ? counts.nearer : counts.farther);
    }
  }
  if (counts.covered > counts.nearer) counts.misfit = misfits / (counts.covered - counts.nearer);
  counts.difference_m = median(&differences);
  const Outline outline = outlineOf(frame_, image, scale_);
  counts.outline = outline.measured;
  counts.continuing = outline.continuing;
  return counts;
}

double PoseCost::support(const Eigen::Isometry3d& pose) {
  const double saved = kLargestCost - (*this)(pose);
  return saved <= 0.0 ? 0.0 : saved * cv::countNonZero(image_.depth(image_.region));
}

}  // namespace softbody
