#include "agreement/acceptance.h"

#include "agreement/body_edges.h"
#include "agreement/confinement.h"
#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"

namespace softbody {

bool isShown(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
             const RegistrationConfig& config) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  return PoseCost(small, mesh, config.distance_scale_m).agreement(pose).misfit <= config.max_cost &&
         confinement(frame, mesh, pose, config.distance_scale_m) >= kLeastConfinement;
}

double freeCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                double distance_scale_m) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  return PoseCost(small, mesh, distance_scale_m, kOtherObject)(pose);
}

bool standsFree(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose,
                const RegistrationConfig& config) {
  return freeCost(frame, mesh, pose, config.distance_scale_m) <= config.max_cost &&
         shareWithoutEdge(frame, mesh, pose, config.distance_scale_m) <= kLargestShareWithoutEdge;
}

}  // namespace softbody
