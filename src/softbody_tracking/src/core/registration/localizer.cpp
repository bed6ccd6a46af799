#include "registration/localizer.h"

#include <algorithm>
#include <cmath>

#include "registration/pose_search.h"
#include "softbody_common/rasterizer.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr double kAlikeCost = 0.02;  // poses in one place whose costs differ by less look alike
constexpr double kSamePlace = 0.5;   // of the pixels that either of two poses covers, covered by both
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

/// Poses that look alike, and how well the body's features are found at each.
struct AlikePoses {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<double> shares;
};

/// The pose at which most features are found; none where they are hardly found at any.
std::optional<Localization> confirmed(const AlikePoses& alike) {
  const auto most = std::max_element(alike.shares.begin(), alike.shares.end());
  if (*most < kSmallestFeatureShare) return std::nullopt;
  return Localization{alike.poses[static_cast<std::size_t>(most - alike.shares.begin())], 1};
}

/// The first pose that too few features are expected at to tell.
std::optional<Localization> undecided(const AlikePoses& alike) {
  const auto unknown = [](double share) { return share < 0.0; };
  const auto first = std::find_if(alike.shares.begin(), alike.shares.end(), unknown);
  if (first == alike.shares.end()) return std::nullopt;
  return Localization{alike.poses[static_cast<std::size_t>(first - alike.shares.begin())],
                      static_cast<int>(std::count_if(first, alike.shares.end(), unknown))};
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

/// Whether the body at two poses covers mostly the same pixels.
bool Localizer::inSamePlace(const Pinhole& camera, const Eigen::Isometry3d& a,
                            const Eigen::Isometry3d& b) const {
  RasterImage at_a, at_b;
  rasterize(camera, transformed(coarse_.vertices, a), coarse_.triangles, &at_a);
  rasterize(camera, transformed(coarse_.vertices, b), coarse_.triangles, &at_b);
  const cv::Mat1b covered_a = at_a.depth > 0.0f, covered_b = at_b.depth > 0.0f;
  return cv::countNonZero(covered_a & covered_b) > kSamePlace * cv::countNonZero(covered_a | covered_b);
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
  std::optional<Localization> likeliest;
  for (bool first = true; !found.empty(); first = false) {
    const RegistrationResult best = found.front();
    const auto others =
        std::stable_partition(found.begin() + 1, found.end(), [&](const RegistrationResult& pose) {
          return std::abs(pose.cost - best.cost) <= kAlikeCost &&
                 inSamePlace(frame.camera, pose.pose, best.pose);
        });
    AlikePoses alike;
    for (auto pose = found.begin(); pose != others; ++pose) {
      alike.poses.push_back(pose->pose);
      alike.shares.push_back(feature_share(pose->pose));
    }
    if (std::optional<Localization> body = confirmed(alike)) return body;
    if (first) likeliest = undecided(alike);
    found.erase(found.begin(), others);
  }
  return likeliest;
}

}  // namespace softbody
