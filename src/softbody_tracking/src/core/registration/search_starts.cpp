#include "registration/search_starts.h"

#include <algorithm>
#include <cmath>

#include "registration/found_pose.h"

namespace softbody {
namespace {

// Viewing directions, with turns about each that are as far apart: 144 orientations.
constexpr int kViews = 18;

/// Views from the directions of a Fibonacci sphere, each with turns about the viewing axis.
std::vector<Eigen::Matrix3d> orientations() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Matrix3d> result;
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  const int turns = static_cast<int>(std::lround(std::sqrt(M_PI * kViews)));
  for (int i = 0; i < kViews; ++i) {
    const double height = 1.0 - 2.0 * (i + 0.5) / kViews;
    const Eigen::Matrix3d view =
        (Eigen::AngleAxisd(golden_angle * i, z) * Eigen::AngleAxisd(std::acos(height), x)).toRotationMatrix();
    for (int k = 0; k < turns; ++k) {
      result.push_back(Eigen::AngleAxisd(2.0 * M_PI * k / turns, z) * view.transpose());
    }
  }
  return result;
}

/// Mean of the side that a mesh shows in a direction, in the image. @param view from the camera, rest frame.
Eigen::Vector3d shownCenter(const TriangleMesh& mesh, const Eigen::Vector3d& view) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(triangle[0]), b = mesh.vertices.row(triangle[1]),
                          c = mesh.vertices.row(triangle[2]);
    const double size = std::max(0.0, -(b - a).cross(c - a).dot(view));
    sum += size / 3.0 * (a + b + c);
    weight += size;
  }
  return weight > 0.0 ? Eigen::Vector3d(sum / weight) : Eigen::Vector3d(mesh.vertices.colwise().mean());
}

}  // namespace

std::vector<Eigen::Vector3d> smallTurns() {
  std::vector<Eigen::Vector3d> turns;
  for (double x : {0.0, kOtherTurn, -kOtherTurn}) {
    for (double y : {0.0, kOtherTurn, -kOtherTurn}) {
      for (double z : {0.0, kOtherTurn, -kOtherTurn}) turns.emplace_back(x, y, z);
    }
  }
  return turns;
}

std::vector<Eigen::Vector3d> shiftsWithin(double reach_m, double spacing_m) {
  const double step_m = std::max(spacing_m, 0.5 * reach_m);
  const int most = static_cast<int>(reach_m / step_m);
  std::vector<Eigen::Vector3d> shifts;
  for (int x = -most; x <= most; ++x)
    for (int y = -most; y <= most; ++y)
      if (x != 0 || y != 0) shifts.emplace_back(x * step_m, y * step_m, 0.0);
  return shifts;
}

std::vector<Eigen::Isometry3d> allOrientations(const SearchMeshes& meshes,
                                               const Eigen::Vector3d& visible_center) {
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Matrix3d& R : orientations()) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R;
    const Eigen::Vector3d view = R.transpose() * visible_center.normalized();
    pose.translation() = visible_center - R * shownCenter(meshes.coarse, view);
    starts.push_back(pose);
  }
  return starts;
}

}  // namespace softbody
