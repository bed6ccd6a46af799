#include "registration/pose_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kUnmeasuredCost = 0.3;
// Less than free space: an occluder is possible, seeing through a body is not.
constexpr double kNearerCost = 0.7;
constexpr double kFewestMeasured = 0.25;  // of the covered pixels; with fewer a pose cannot be judged
constexpr double kPreferredTurn = 0.05;   // of the cost, a radian away from a preferred pose,
constexpr double kPreferredPlace = 0.02;  // and at most so much for the distance from it
constexpr double kImprovement = 1e-6;     // of the cost; less is rounding

/// Far away depth is noisier. @param scale up to 1 m.
double scaleAt(double z, double scale) { return scale * std::max(1.0, z); }

double pixelCost(double measured, double predicted, double scale) {
  if (measured <= 0.0) return kUnmeasuredCost;
  const double ratio = (measured - predicted) / scaleAt(predicted, scale);
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
        if (z > 0.0f && std::abs(z - image.depth(v, u)) < 0.5 * scaleAt(z, scale)) ++count;
      }
    }
  }
  return count;
}

/// Like the square, and not above 1: a rough pose that is far off must not draw the body along the ray.
double saturated(double ratio2) { return ratio2 / (1.0 + ratio2); }

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

struct AreaMoments {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< about the centre [m^4]
};

/// Of a mesh's surface: its vertices may lie closer in some places than in others.
AreaMoments areaMoments(const TriangleMesh& mesh) {
  const auto overTriangles = [&](const auto& add) {
    for (const auto& triangle : mesh.triangles.rowwise()) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = mesh.vertices.row(triangle[k]);
      const Eigen::Vector3d a = corners.col(1) - corners.col(0), b = corners.col(2) - corners.col(0);
      add(corners, 0.5 * a.cross(b).norm());
    }
  };
  AreaMoments moments;
  double sum = 0.0;
  overTriangles([&](const Eigen::Matrix3d& corners, double area) {
    moments.center += area * corners.rowwise().mean();
    sum += area;
  });
  if (sum > 0.0) moments.center /= sum;
  overTriangles([&](const Eigen::Matrix3d& corners, double area) {
    const Eigen::Matrix3d arms = corners.colwise() - moments.center;
    const Eigen::Vector3d middle = arms.rowwise().sum();
    moments.spread += area / 12.0 * (arms * arms.transpose() + middle * middle.transpose());
  });
  return moments;
}

}  // namespace

RgbdFrame subsampled(const RgbdFrame& frame, int columns) {
  const int k = std::max(1, frame.camera.width / columns);
  if (k == 1) return frame;
  RgbdFrame small;
  small.stamp = frame.stamp;
  const int offset = k / 2;
  small.camera = {frame.camera.width / k, frame.camera.height / k,        frame.camera.fx / k,
                  frame.camera.fy / k,    (frame.camera.cx - offset) / k, (frame.camera.cy - offset) / k};
  small.color.create(small.camera.height, small.camera.width);
  small.depth.create(small.camera.height, small.camera.width);
  for (int v = 0; v < small.depth.rows; ++v) {
    for (int u = 0; u < small.depth.cols; ++u) {
      small.color(v, u) = frame.color(v * k + offset, u * k + offset);
      small.depth(v, u) = frame.depth(v * k + offset, u * k + offset);
    }
  }
  return small;
}

PoseSearch::PoseSearch(const RgbdFrame& frame, const TriangleMesh& mesh, double distance_scale_m)
    : frame_(frame), mesh_(mesh), scale_(distance_scale_m) {
  const AreaMoments moments = areaMoments(mesh);
  center_ = moments.center;
  axes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.spread).eigenvectors();
}

double PoseSearch::cost(const Eigen::Isometry3d& pose) {
  rasterize(frame_.camera, transformed(mesh_.vertices, pose), mesh_.triangles, &image_);
  return renderedCost(frame_, image_, scale_);
}

double PoseSearch::support(const Eigen::Isometry3d& pose) {
  const double saved = kWorstCost - cost(pose);
  return saved <= 0.0 ? 0.0 : saved * cv::countNonZero(image_.depth(image_.region));
}

double PoseSearch::rankedCost(const Eigen::Isometry3d& pose) {
  if (!preferred_) return cost(pose);
  const double angle = Eigen::AngleAxisd(pose.linear().transpose() * preferred_->linear()).angle();
  const Eigen::Vector3d center = pose * center_;
  const double shift = (center - *preferred_ * center_).norm() / scaleAt(center.z(), scale_);
  return cost(pose) + kPreferredTurn * angle * angle + kPreferredPlace * saturated(shift * shift);
}

Eigen::Isometry3d PoseSearch::moved(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn,
                                    const Eigen::Vector3d& shift) const {
  const Eigen::Vector3d center = pose * center_;
  const double angle = turn.norm();
  const Eigen::AngleAxisd rotation(angle,
                                   angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX());
  return Eigen::Translation3d(center + shift) * rotation * Eigen::Translation3d(-center) * pose;
}

Eigen::Isometry3d PoseSearch::icp(Eigen::Isometry3d pose, int iterations) {
  const double scale = scaleAt((pose * center_).z(), scale_);
  double gate = 4.0 * scale;
  const double narrowing = std::pow(0.25, 1.0 / std::max(1, iterations - 5));
  for (int i = 0; i < iterations; ++i) {
    pose = rigidStep(refsTo(associations(pose, gate))) * pose;
    gate = std::max(scale, narrowing * gate);
  }
  return pose;
}

RegistrationResult PoseSearch::refine(const Eigen::Isometry3d& start, double turn_step, double shift_step) {
  RegistrationResult best{start, rankedCost(start)};
  while (shift_step > 2e-4) {
    bool improved = false;
    for (int axis = 0; axis < 6; ++axis) {
      for (double sign : {1.0, -1.0}) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero(), shift = Eigen::Vector3d::Zero();
        if (axis < 3)
          turn = sign * turn_step * (best.pose.linear() * axes_.col(axis));
        else
          shift[axis - 3] = sign * shift_step;
        const Eigen::Isometry3d pose = moved(best.pose, turn, shift);
        const double pose_cost = rankedCost(pose);
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

std::vector<Association> PoseSearch::associations(const Eigen::Isometry3d& pose, double gate) {
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

double poseCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                double distance_scale_m) {
  return PoseSearch(frame, mesh, distance_scale_m).cost(pose);
}

}  // namespace softbody
