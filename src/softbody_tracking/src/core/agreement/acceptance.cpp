#include "agreement/acceptance.h"

#include "agreement/body_edges.h"
#include "agreement/confinement.h"
#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"

namespace softbody {

bool isShown(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  return PoseCost(small, mesh).agreement(pose).misfit <= kLargestCost &&
         confinement(frame, mesh, pose) >= kLeastConfinement;
}

double freeCost(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const RgbdFrame small = subsampled(frame, kLargeColumns);
  return PoseCost(small, mesh, kOtherObject)(pose);
}

bool standsFree(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  return freeCost(frame, mesh, pose) <= kLargestCost &&
         shareWithoutEdge(frame, mesh, pose) <= kLargestShareWithoutEdge;
}

}  // namespace softbody
