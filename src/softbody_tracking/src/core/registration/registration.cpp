#include "registration/registration.h"

#include <algorithm>
#include <array>
#include <vector>

#include "registration/pose_search.h"

namespace softbody {
namespace {

constexpr int kIcpIterations = 15;
constexpr std::size_t kBestStarts = 4;

}  // namespace

RegistrationResult registerBody(const RgbdFrame& frame, const TriangleMesh& mesh, const TriangleMesh& coarse,
                                const Eigen::Isometry3d& rough_pose, const RegistrationConfig& config) {
  const RgbdFrame small = subsampled(frame, 160);
  PoseSearch search(small, coarse, config.distance_scale_m);
  search.prefer(rough_pose);
  std::vector<RegistrationResult> starts;
  const std::array<double, 3> turns{0.0, 0.2, -0.2};  // [rad]
  for (double x : turns) {
    for (double y : turns) {
      for (double z : turns) {
        const Eigen::Isometry3d pose =
            search.icp(search.moved(rough_pose, {x, y, z}, Eigen::Vector3d::Zero()), kIcpIterations);
        starts.push_back({pose, search.rankedCost(pose)});
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

  const RgbdFrame fine = subsampled(frame, 320);
  PoseSearch last(fine, mesh, config.distance_scale_m);
  last.prefer(rough_pose);
  const Eigen::Isometry3d pose = last.refine(best.pose, 0.02, 0.003).pose;
  return {pose, last.cost(pose)};
}

}  // namespace softbody
