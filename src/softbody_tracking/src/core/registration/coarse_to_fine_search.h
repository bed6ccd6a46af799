#pragma once

#include <optional>
#include <vector>

#include "registration/coarse_mesh.h"
#include "registration/pose_refinement.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The best poses of a step that go on to the next one; a box has four that look alike. Also the places that
/// are searched.
constexpr std::size_t kKept = 4;

void sortByCost(std::vector<PoseHypothesis>* poses);

/// The search for the body's pose in one frame, from coarse to fine. The caller gives the starts: poses near
/// a given pose (search_near_pose.h), or every orientation at every candidate (search_anywhere.h). The meshes
/// must outlive it.
class CoarseToFineSearch {
 public:
  /// @param rough see PoseRefinement.
  CoarseToFineSearch(const RgbdFrame& frame, const SearchMeshes& meshes,
                     const std::optional<RoughPose>& rough = std::nullopt);
  CoarseToFineSearch(const CoarseToFineSearch&) = delete;
  CoarseToFineSearch& operator=(const CoarseToFineSearch&) = delete;

  /// A start turned about the body's centre. @param turn rotation vector [rad].
  Eigen::Isometry3d turned(const Eigen::Isometry3d& pose, const Eigen::Vector3d& turn) const;

  /// The pose turned by quarters of a turn about the body's principal axes, in all 24 ways; the first is the
  /// pose itself.
  std::vector<Eigen::Isometry3d> quarterTurned(const Eigen::Isometry3d& pose) const;

  /// Step 1: ICP from every start with the coarse mesh on a small image, on all cores. @return the lowest
  /// cost first.
  std::vector<PoseHypothesis> align(const std::vector<Eigen::Isometry3d>& starts) const;
  /// Step 2: pattern search with the coarse mesh on a medium image, likewise.
  std::vector<PoseHypothesis> refine(std::vector<PoseHypothesis> poses) const;
  /// Step 3: pattern search with the fine mesh on a large image, likewise.
  std::vector<PoseHypothesis> polish(std::vector<PoseHypothesis> poses) const;

  /// Sorted by support in the images of step 2, the most first; then by cost.
  std::vector<PoseHypothesis> rankRefined(std::vector<PoseHypothesis> poses);
  /// The same in the images of step 3.
  std::vector<PoseHypothesis> rankPolished(std::vector<PoseHypothesis> poses);
  /// PoseCost in the images of step 3.
  double polishedCost(const Eigen::Isometry3d& pose) { return polishing_.cost()(pose); }

  /// The image of step 2.
  const RgbdFrame& mediumFrame() const { return medium_; }

 private:
  RgbdFrame small_, medium_, large_;
  PoseRefinement alignment_, refinement_, polishing_;
};

}  // namespace softbody
