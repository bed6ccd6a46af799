#include "localizer.h"

#include <algorithm>

#include "pose_search.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kAlikeCost = 0.02;  // poses whose costs differ by less look alike
constexpr double kLargestForeignShare = 0.5;
constexpr double kSmallestFeatureShare = 0.15;
constexpr Eigen::Index kManyVertices = 3000;  // more than a small picture shows
constexpr double kCoarseCells = 60.0;         // over the body's diameter

/// A mesh quick to render where the given one is finer than a small picture shows.
TriangleMesh simplified(const TriangleMesh& mesh) {
  if (mesh.vertices.rows() <= kManyVertices) return mesh;
  const Eigen::Vector3d size = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  return clustered(mesh, size.norm() / kCoarseCells);
}

}  // namespace

Localizer::Localizer(const TriangleMesh& rest_surface, const RegistrationConfig& config)
    : config_(config),
      rest_surface_(rest_surface),
      coarse_(simplified(rest_surface)),
      finder_(rest_surface, config) {}

std::optional<Localization> Localizer::near(const RgbdFrame& frame,
                                            const Eigen::Isometry3d& rough_pose) const {
  const RegistrationResult found = registerBody(frame, rest_surface_, coarse_, rough_pose, config_);
  if (found.cost > config_.max_cost) return std::nullopt;
  return Localization{found.pose, 1};
}

std::optional<Localization> Localizer::recognized(const RgbdFrame& frame, const Eigen::Isometry3d& pose,
                                                  const FeatureShare& feature_share) const {
  std::optional<Localization> found = near(frame, pose);
  if (!found || feature_share(found->pose) < kSmallestFeatureShare) return std::nullopt;
  return found;
}

/// Share of the pixels covered at a pose whose colour is none of the body's.
double Localizer::foreignShare(const RgbdFrame& frame, const ColorModel& colors,
                               const Eigen::Isometry3d& pose) const {
  RasterImage image;
  rasterize(frame.camera, transformed(rest_surface_.vertices, pose), rest_surface_.triangles, &image);
  int covered = 0, foreign = 0;
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      if (image.triangle(v, u) < 0) continue;
      ++covered;
      foreign += colors.belongs(frame.color(v, u)) ? 0 : 1;
    }
  }
  return covered == 0 ? 1.0 : static_cast<double>(foreign) / covered;
}

std::optional<Localization> Localizer::anywhere(const RgbdFrame& frame, const ColorModel& colors,
                                                const std::vector<Eigen::Isometry3d>& guesses,
                                                const FeatureShare& feature_share) const {
  std::vector<RegistrationResult> found = finder_.find(frame, colors, guesses);
  const auto implausible = [&](const RegistrationResult& pose) {
    return pose.cost > std::min(kWorstCost, config_.max_cost) ||
           foreignShare(frame, colors, pose.pose) > kLargestForeignShare;
  };
  found.erase(std::remove_if(found.begin(), found.end(), implausible), found.end());
  if (found.empty()) return std::nullopt;
  const double best_cost = found.front().cost;
  found.erase(
      std::remove_if(found.begin(), found.end(),
                     [&](const RegistrationResult& pose) { return pose.cost > best_cost + kAlikeCost; }),
      found.end());
  Localization best{found.front().pose, static_cast<int>(found.size())};
  double best_share = feature_share(best.pose);
  for (std::size_t i = 1; i < found.size(); ++i) {
    const double share = feature_share(found[i].pose);
    if (share <= best_share) continue;
    best_share = share;
    best.pose = found[i].pose;
  }
  if (best_share >= 0.0 && best_share < kSmallestFeatureShare) return std::nullopt;
  if (best_share >= kSmallestFeatureShare) best.alike = 1;
  return best;
}

}  // namespace softbody
