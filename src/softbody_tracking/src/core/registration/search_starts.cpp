#include "registration/search_starts.h"

#include <cmath>

#include "registration/found_pose.h"

namespace softbody {
namespace {

// Viewing directions and turns about each: 144 orientations, about 35 degrees apart.
constexpr int kViews = 24, kTurns = 6;
// Diameters by which the body's middle lies behind the middle of its visible side.
constexpr double kBehind = 0.1;

/// Views from the directions of a Fibonacci sphere, each with turns about the viewing axis.
std::vector<Eigen::Matrix3d> orientations() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Matrix3d> result;
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kViews; ++i) {
    const double height = 1.0 - 2.0 * (i + 0.5) / kViews;
    const Eigen::Matrix3d view =
        (Eigen::AngleAxisd(golden_angle * i, z) * Eigen::AngleAxisd(std::acos(height), x)).toRotationMatrix();
    for (int k = 0; k < kTurns; ++k) {
      result.push_back(Eigen::AngleAxisd(2.0 * M_PI * k / kTurns, z) * view.transpose());
    }
  }
  return result;
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

std::vector<Eigen::Isometry3d> allOrientations(const SearchMeshes& meshes,
                                               const Eigen::Vector3d& visible_center) {
  const Points& vertices = meshes.full.vertices;
  const Eigen::Vector3d middle = 0.5 * (vertices.colwise().maxCoeff() + vertices.colwise().minCoeff());
  const Eigen::Vector3d behind = visible_center + kBehind * meshes.diameter_m * visible_center.normalized();
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Matrix3d& R : orientations()) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R;
    pose.translation() = behind - R * middle;
    starts.push_back(pose);
  }
  return starts;
}

}  // namespace softbody
