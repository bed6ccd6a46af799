#include "tracker/body_search.h"

#include <vector>

#include "registration/search_anywhere.h"
#include "registration/search_near_pose.h"
#include "search_report/search_measurement.h"
#include "softbody_tracking/known/known_surface.h"

namespace softbody {
namespace {

// Largest cost of a pose that features then have to confirm: a lost body may be bent.
constexpr double kDeformedCost = 0.5;
// How fast a body's place becomes uncertain while nobody sees it [m/s], as a standard deviation.
constexpr double kWandering = 0.05;

}  // namespace

void BodySearch::reset() {
  first_frame_ = true;
  tracked_ = recovering_ = placed_ = false;
  given_.reset();
  lost_since_.reset();
  for (Backoff* search : {&depth_search_, &feature_search_, &scale_search_}) search->reset();
  fitting_scale_.reset();
  report_ = {};
}

void BodySearch::startNear(const Eigen::Isometry3d& rough_pose) {
  first_frame_ = false;
  given_ = pose_ = rough_pose;
}

void BodySearch::placeAt(const Eigen::Isometry3d& pose) {
  startNear(pose);
  placed_ = true;
}

BodySearch::Outcome BodySearch::locate(const RgbdFrame& frame, FrameObserver* observer, StageTimer* timer) {
  if (first_frame_) takeInitialPose(frame, observer->model().volume());
  if (placed_) {
    placed_ = false;
    startTracking(frame, {frame.T_fixed_camera.inverse() * pose_, 1});
    return Outcome::kPlaced;
  }
  if (lost_since_ && frame.stamp - *lost_since_ >= kLongestGap) {
    tracked_ = false;
    recovering_ = true;
    lost_since_.reset();
  }
  std::optional<FoundPose> found;
  if (recovering_) found = searchByFeatures(frame, observer, timer);
  if (!found && tracked_) return Outcome::kTracked;
  if (!found) found = searchByDepth(frame, observer, timer);
  if (!found) return Outcome::kNotFound;
  startTracking(frame, *found);
  return Outcome::kFound;
}

void BodySearch::noteLoss(bool lost, Nanoseconds stamp) {
  if (!lost) {
    lost_since_.reset();
    last_seen_ = stamp;
  } else if (!lost_since_) {
    lost_since_ = stamp;
  }
  recovering_ = recovering_ && lost;
}

/// The pose in the object's file refers to the camera at the start.
void BodySearch::takeInitialPose(const RgbdFrame& frame, const TetTopology& volume) {
  pose_ = frame.T_fixed_camera * volume.initial_pose;
  if (volume.has_initial_pose) given_ = pose_;
  first_frame_ = false;
}

void BodySearch::prepareMeshes(const MeshTopology& surface) {
  meshes_ = std::make_unique<SearchMeshes>(makeSearchMeshes(surface, picture_));
}

const SearchMeshes& BodySearch::meshesOf(const MeshTopology& surface) {
  if (meshes_ == nullptr) prepareMeshes(surface);
  return *meshes_;
}

void BodySearch::startTracking(const RgbdFrame& frame, const FoundPose& found) {
  pose_ = frame.T_fixed_camera * found.pose;
  alike_ = found.alike;
  tracked_ = true;
  lost_since_.reset();
  for (Backoff* search : {&depth_search_, &feature_search_}) search->reset();
  found_at_ = last_seen_ = frame.stamp;
}

/// A lost body is found in the first frame that shows enough of its features.
std::optional<FoundPose> BodySearch::searchByFeatures(const RgbdFrame& frame, FrameObserver* observer,
                                                      StageTimer* timer) {
  if (!feature_search_.isDue(frame.stamp)) return std::nullopt;
  const std::optional<Eigen::Isometry3d> rough = observer->recognizePose(frame);
  if (!rough) return std::nullopt;
  feature_search_.failed();
  const auto scope = timer->stage("Model Registration", true);
  const PoseHypothesis found = searchNearPose(withoutKnownDepth(frame), meshesOf(observer->model().surface()),
                                              roughPose(*rough, config_));
  // Features distinguish poses that are alike in depth.
  if (found.cost > kDeformedCost || !confirms(observer->featureShare(frame, found.pose))) return std::nullopt;
  return FoundPose{found.pose, 1};
}

std::optional<FoundPose> BodySearch::searchByDepth(const RgbdFrame& frame, FrameObserver* observer,
                                                   StageTimer* timer) {
  if (!depth_search_.isDue(frame.stamp)) return std::nullopt;
  depth_search_.failed();
  const auto scope = timer->stage("Model Registration", true);
  const SearchMeshes& meshes = meshesOf(observer->model().surface());
  const RgbdFrame searched = withoutKnownDepth(frame);
  const SearchOutcome outcome = searchByDepthNow(searched, meshes, observer);
  if (!outcome.found) report_ = explained(searched, meshes, *observer, outcome);
  return outcome.found;
}

SearchOutcome BodySearch::searchByDepthNow(const RgbdFrame& frame, const SearchMeshes& meshes,
                                           FrameObserver* observer) const {
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  if (given_ && !recovering_) {
    const SearchOutcome near =
        searchNearAccepted(frame, meshes, roughPose(T_camera_fixed * *given_, config_));
    if (near.found || !searchesAnywhere()) return near;
  }
  std::vector<Eigen::Isometry3d> guesses;
  if (recovering_ || given_) guesses.push_back(T_camera_fixed * pose_);
  std::optional<RoughPose> expected;
  if (recovering_) expected = lastPose(frame);
  const auto feature_share = [&](const Eigen::Isometry3d& pose) {
    return observer->featureShare(frame, pose);
  };
  return searchAnywhere(frame, observer->colors(), meshes, guesses, feature_share, expected);
}

/// Where a lost body may be.
RoughPose BodySearch::lastPose(const RgbdFrame& frame) const {
  RoughPose last = roughPose(frame.T_fixed_camera.inverse() * pose_, config_);
  last.std_m += kWandering * seconds(frame.stamp - last_seen_);
  return last;
}

/// Another scale of the mesh is tried only at the start, because it does not change later; and less and less
/// often, because it takes as long as a few searches.
SearchReport BodySearch::explained(const RgbdFrame& frame, const SearchMeshes& meshes,
                                   const FrameObserver& observer, const SearchOutcome& outcome) {
  std::optional<RoughPose> rough;
  if (!searchesAnywhere()) rough = roughPose(frame.T_fixed_camera.inverse() * *given_, config_);
  SearchReport report = measureSearch(frame, observer.colors(), meshes, outcome, rough);
  if (recovering_) return report;
  if (scale_search_.isDue(frame.stamp)) {
    fitting_scale_ = fittingScale(frame, observer.colors(), meshes, outcome.best);
    scale_search_.failed();
  }
  report.fitting_scale = fitting_scale_;
  return report;
}

}  // namespace softbody
