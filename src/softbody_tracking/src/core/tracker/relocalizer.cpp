#include "tracker/relocalizer.h"

#include <vector>

#include "registration/body_edges.h"
#include "registration/search_anywhere.h"
#include "registration/search_near_pose.h"

namespace softbody {
namespace {

// Consecutive lost frames after which the body is searched for; a hand may cover it for a moment.
constexpr int kLostFramesBeforeSearch = 10;
// Largest cost of a pose that features then have to confirm: a lost body may be bent.
constexpr double kDeformedCost = 0.5;
// Frames from one search that failed to the next: a search anywhere takes about a second.
constexpr int kFramesBetweenSearches = 10;

}  // namespace

void Relocalizer::reset() {
  first_frame_ = true;
  tracked_ = recovering_ = false;
  given_.reset();
  lost_frames_ = frames_to_depth_search_ = frames_to_feature_search_ = 0;
}

void Relocalizer::startNear(const Eigen::Isometry3d& rough_pose) {
  first_frame_ = false;
  given_ = pose_ = rough_pose;
}

Relocalizer::Outcome Relocalizer::locate(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer) {
  if (first_frame_) takeInitialPose(frame, observer->surface().volume());
  if (lost_frames_ >= kLostFramesBeforeSearch) {
    tracked_ = false;
    recovering_ = true;
    lost_frames_ = 0;
  }
  std::optional<FoundPose> found;
  if (recovering_) found = searchByFeatures(frame, observer, timer);
  if (!found && tracked_) return Outcome::kTracked;
  if (!found) found = searchByDepth(frame, observer, timer);
  if (!found) return Outcome::kNotFound;
  startTracking(frame, *found);
  return Outcome::kFound;
}

void Relocalizer::countLoss(bool lost) {
  lost_frames_ = lost ? lost_frames_ + 1 : 0;
  recovering_ = recovering_ && lost;
}

/// The pose in the object's file refers to the camera at the start.
void Relocalizer::takeInitialPose(const RgbdFrame& frame, const TetTopology& volume) {
  pose_ = frame.T_fixed_camera * volume.initial_pose;
  if (volume.has_initial_pose) given_ = pose_;
  first_frame_ = false;
}

const SearchMeshes& Relocalizer::meshesOf(const MeshTopology& surface) {
  if (meshes_ == nullptr)
    meshes_ = std::make_unique<SearchMeshes>(makeSearchMeshes({surface.rest_vertices, surface.triangles}));
  return *meshes_;
}

void Relocalizer::startTracking(const RgbdFrame& frame, const FoundPose& found) {
  pose_ = frame.T_fixed_camera * found.pose;
  alike_ = found.alike;
  tracked_ = true;
  lost_frames_ = frames_to_depth_search_ = frames_to_feature_search_ = 0;
  found_at_ = frame.stamp;
}

std::optional<FoundPose> Relocalizer::acceptableNear(const RgbdFrame& frame, const SearchMeshes& meshes,
                                                     const Eigen::Isometry3d& rough_pose,
                                                     double max_cost) const {
  const PoseHypothesis found = searchNearPose(frame, meshes, rough_pose, config_.distance_scale_m);
  if (found.cost > max_cost) return std::nullopt;
  return FoundPose{found.pose, 1};
}

/// A lost body is found in the first frame that shows enough of its features.
std::optional<FoundPose> Relocalizer::searchByFeatures(const RgbdFrame& frame, FrameObserver* observer,
                                                       StageTimer* timer) {
  if (frames_to_feature_search_-- > 0) return std::nullopt;
  const std::optional<Eigen::Isometry3d> rough = observer->recognizePose(frame);
  frames_to_feature_search_ = rough ? kFramesBetweenSearches : 0;
  if (!rough) return std::nullopt;
  const auto scope = timer->stage("Model Registration", true);
  auto found = acceptableNear(frame, meshesOf(observer->surface().topology()), *rough, kDeformedCost);
  // Features distinguish poses that are alike in depth.
  if (!found || !confirms(observer->featureShare(frame, found->pose))) return std::nullopt;
  return found;
}

std::optional<FoundPose> Relocalizer::searchByDepth(const RgbdFrame& frame, FrameObserver* observer,
                                                    StageTimer* timer) {
  if (frames_to_depth_search_-- > 0) return std::nullopt;
  frames_to_depth_search_ = kFramesBetweenSearches;
  const auto scope = timer->stage("Model Registration", true);
  const SearchMeshes& meshes = meshesOf(observer->surface().topology());
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  if (given_ && !recovering_) {
    auto found = acceptableNear(frame, meshes, T_camera_fixed * *given_, config_.max_cost);
    const bool bounded = found && shareWithoutEdge(frame, meshes.full, found->pose,
                                                   config_.distance_scale_m) <= kLargestShareWithoutEdge;
    if (bounded) return found;
  }
  std::vector<Eigen::Isometry3d> guesses;
  if (recovering_ || given_) guesses.push_back(T_camera_fixed * pose_);
  const auto feature_share = [&](const Eigen::Isometry3d& pose) {
    return observer->featureShare(frame, pose);
  };
  return searchAnywhere(frame, observer->colors(), meshes, guesses, feature_share, config_);
}

}  // namespace softbody
