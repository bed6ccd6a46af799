#include "registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "association.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kUnmeasuredCost = 0.3;
constexpr double kNearerCost =
    0.7;  // less than free space: an occluder is possible, seeing through a body is not
constexpr double kFewestMeasured = 0.25;  // of the covered pixels; with fewer a pose cannot be judged
constexpr double kImprovement = 1e-6;     // of the cost; less is rounding
constexpr int kIcpIterations = 15;
constexpr std::size_t kBestStarts = 4;

/// Every k-th pixel, with the camera that belongs to it.
RgbdFrame subsampled(const RgbdFrame& frame, int k) {
  if (k == 1) return frame;
  RgbdFrame small;
  small.stamp = frame.stamp;
  const int offset = k / 2;
  small.camera = {frame.camera.width / k, frame.camera.height / k,        frame.camera.fx / k,
                  frame.camera.fy / k,    (frame.camera.cx - offset) / k, (frame.camera.cy - offset) / k};
  small.depth.create(small.camera.height, small.camera.width);
  for (int v = 0; v < small.depth.rows; ++v) {
    for (int u = 0; u < small.depth.cols; ++u)
      small.depth(v, u) = frame.depth(v * k + offset, u * k + offset);
  }
  return small;
}

double pixelCost(double measured, double predicted, double scale) {
  if (measured <= 0.0) return kUnmeasuredCost;
  const double ratio = (measured - predicted) / scale;
  if (ratio < -1.0) return kNearerCost;
  return std::min(1.0, ratio * ratio);
}

/// Number of pixels just outside the rendered outline whose depth continues the surface.
int continuingOutlinePixels(const RgbdFrame& frame, const RasterImage& image, double scale) {
  static constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const cv::Rect inner(2, 2, image.depth.cols - 4, image.depth.rows - 4);
  const cv::Rect region = image.region & inner;
  int count = 0;
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) {
      if (image.triangle(v, u) < 0) continue;
      for (const auto& step : kSteps) {
        const int next_u = u + step[0], next_v = v + step[1], beyond_u = u + 2 * step[0],
                  beyond_v = v + 2 * step[1];
        if (image.triangle(next_v, next_u) >= 0 || image.triangle(beyond_v, beyond_u) >= 0) continue;
        const float z = frame.depth(beyond_v, beyond_u);
        if (z > 0.0f && std::abs(z - image.depth(v, u)) < 0.5 * scale) ++count;
      }
    }
  }
  return count;
}

double renderedCost(const RgbdFrame& frame, const RasterImage& image, double scale) {
  double sum = 0.0;
  int covered = 0, measured = 0;
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      if (image.triangle(v, u) < 0) continue;
      ++covered;
      measured += frame.depth(v, u) > 0.0f ? 1 : 0;
      sum += pixelCost(frame.depth(v, u), image.depth(v, u), scale);
    }
  }
  if (measured <= kFewestMeasured * covered) return 1.0;
  return (sum + 0.5 * continuingOutlinePixels(frame, image, scale)) / covered;
}

/// Searches poses of one mesh in one frame.
class PoseSearch {
 public:
  PoseSearch(const RgbdFrame& frame, const TriangleMesh& mesh, double scale)
      : frame_(frame), mesh_(mesh), scale_(scale), center_(mesh.vertices.colwise().mean().transpose()) {}

  double cost(const Eigen::Isometry3d& pose) {
    rasterize(frame_.camera, transformed(mesh_.vertices, pose), mesh_.triangles, &image_);
    return renderedCost(frame_, image_, scale_);
  }

  /// Turns by the vector about the body's centre, then shifts.
  Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn,
                          const Eigen::Vector3d& shift) const {
    const Eigen::Vector3d center = pose * center_;
    const double angle = turn.norm();
    const Eigen::AngleAxisd rotation(angle,
                                     angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX());
    return Eigen::Translation3d(center + shift) * rotation * Eigen::Translation3d(-center) * pose;
  }

  Eigen::Isometry3d icp(Eigen::Isometry3d pose) {
    double gate = 4.0 * scale_;
    for (int i = 0; i < kIcpIterations; ++i) {
      pose = rigidStep(associations(pose, gate)) * pose;
      gate = std::max(scale_, 0.85 * gate);
    }
    return pose;
  }

  /// Pattern search along turns and shifts, steps halved until they are below the depth's own precision.
  RegistrationResult refine(const Eigen::Isometry3d& start, double turn_step, double shift_step) {
    RegistrationResult best{start, cost(start)};
    while (shift_step > 2e-4) {
      bool improved = false;
      for (int axis = 0; axis < 6; ++axis) {
        for (double sign : {1.0, -1.0}) {
          Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
          (axis < 3 ? turn[axis] : shift[axis - 3]) = sign * (axis < 3 ? turn_step : shift_step);
          const Eigen::Isometry3d pose = moved(best.pose, turn, shift);
          const double pose_cost = cost(pose);
          if (pose_cost < best.cost - kImprovement) {
            best = {pose, pose_cost};
            improved = true;
            break;
          }
        }
      }
      if (!improved) {
        turn_step *= 0.5;
        shift_step *= 0.5;
      }
    }
    return best;
  }

 private:
  std::vector<Association> associations(const Eigen::Isometry3d& pose, double gate) {
    const Points vertices = transformed(mesh_.vertices, pose);
    rasterize(frame_.camera, vertices, mesh_.triangles, &image_);
    std::vector<Association> result;
    for (int v = image_.region.y; v < image_.region.br().y; ++v) {
      for (int u = image_.region.x; u < image_.region.br().x; ++u) {
        const int f = image_.triangle(v, u);
        const float z = frame_.depth(v, u);
        if (f < 0 || z <= 0.0f || std::abs(z - image_.depth(v, u)) > gate) continue;
        Association a;
        a.predicted = frame_.camera.unproject(u, v, image_.depth(v, u));
        a.measured = frame_.camera.unproject(u, v, z);
        const Eigen::Vector3d corner = vertices.row(mesh_.triangles(f, 0));
        a.normal = (vertices.row(mesh_.triangles(f, 1)).transpose() - corner)
                       .cross(vertices.row(mesh_.triangles(f, 2)).transpose() - corner)
                       .normalized();
        if (!a.normal.isZero()) result.push_back(a);
      }
    }
    return result;
  }

  const RgbdFrame& frame_;
  const TriangleMesh& mesh_;
  double scale_;
  Eigen::Vector3d center_;
  RasterImage image_;
};

/// Step between pixels so that about this many columns remain.
int subsampling(const Pinhole& camera, int columns) { return std::max(1, camera.width / columns); }

}  // namespace

double poseCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                double distance_scale_m) {
  return PoseSearch(frame, mesh, distance_scale_m).cost(pose);
}

RegistrationResult registerBody(const RgbdFrame& frame, const TriangleMesh& mesh,
                                const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config) {
  const RgbdFrame coarse = subsampled(frame, subsampling(frame.camera, 160));
  PoseSearch search(coarse, mesh, config.distance_scale_m);
  std::vector<RegistrationResult> starts;
  const std::array<double, 3> turns{0.0, 0.2, -0.2};  // [rad]
  for (double x : turns) {
    for (double y : turns) {
      for (double z : turns) {
        const Eigen::Isometry3d pose =
            search.icp(search.moved(rough_pose, {x, y, z}, Eigen::Vector3d::Zero()));
        starts.push_back({pose, search.cost(pose)});
      }
    }
  }
  const auto byCost = [](const RegistrationResult& a, const RegistrationResult& b) {
    return a.cost < b.cost;
  };
  std::stable_sort(starts.begin(), starts.end(), byCost);
  starts.resize(std::min(starts.size(), kBestStarts));
  for (RegistrationResult& start : starts) start = search.refine(start.pose, 0.1, 0.02);
  const RegistrationResult best = *std::min_element(starts.begin(), starts.end(), byCost);

  const RgbdFrame fine = subsampled(frame, subsampling(frame.camera, 320));
  return PoseSearch(fine, mesh, config.distance_scale_m).refine(best.pose, 0.02, 0.003);
}

}  // namespace softbody
