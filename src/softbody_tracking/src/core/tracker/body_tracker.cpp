#include "softbody_tracking/tracker/body_tracker.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "prediction/rigid_prediction.h"
#include "prediction/topology_check.h"
#include "softbody_common/rigid_fit.h"
#include "targets/knn_targets.h"
#include "targets/position_prior.h"
#include "tracker/body_placement.h"
#include "tracker/frame_observer.h"
#include "tracker/tracking_status.h"
#include "tracker/tracking_targets.h"

namespace softbody {
namespace {

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireCameraSize(const RgbdFrame& frame) {
  const cv::Size size(frame.camera.width, frame.camera.height);
  if (frame.color.size() == size && frame.depth.size() == size) return;
  throw std::invalid_argument("colour is " + sizeText(frame.color.size()) + ", depth " +
                              sizeText(frame.depth.size()) + ", but the camera " + sizeText(size));
}

}  // namespace

struct BodyTracker::Implementation {
  explicit Implementation(const TrackerConfig& tracker_config)
      : config(tracker_config), knn(config.knn), placement(config.registration) {}

  const TetTopology& model() const { return observer->surface().volume(); }
  /// Whether a state of the volume answers the targets sent since the body was placed.
  bool answers(const MeshState* volume, Nanoseconds stamp) const;
  Points predict(const RgbdFrame& frame, const MeshState* answer);
  TrackingResult resultOf(const RgbdFrame& frame, const Observation& seen, const MeshState* answer);
  std::vector<Association> all(const Observation& seen, const Eigen::Matrix3d& R_camera_fixed) const;
  TrackingStatus judge(const Observation& seen, const std::vector<Association>& associations);
  void admit(const RgbdFrame& frame, const Observation& seen);
  TrackingResult waiting(const std::string& reason) const;
  void reset();

  TrackerConfig config;
  KnnTargets knn;
  BodyPlacement placement;
  std::unique_ptr<FrameObserver> observer;
  std::unique_ptr<RigidPrediction> prediction;
  std::unique_ptr<PositionPrior> hold;
  HeldPieces held;
  std::vector<bool> moving;  ///< pieces whose velocity is known well enough to go on with; none: all
  Nanoseconds last_stamp = 0;
};

TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& camera_frame,
                            const std::string& output_frame, const std::string& why) {
  TrackingStatus status;
  status.state = last.state == TrackingState::kTracking ? TrackingState::kDegraded : last.state;
  status.features_total = last.features_total;
  status.reason = fmt::format("frame skipped: tf does not say where {} is in output_frame {}: {}",
                              camera_frame, output_frame, why);
  return status;
}

BodyTracker::BodyTracker(const TrackerConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
BodyTracker::~BodyTracker() = default;

void BodyTracker::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  requireWhole(volume, surface);
  Implementation& self = *implementation_;
  const bool edited = ready() && volume.revision > self.model().revision;
  if (edited) {
    self.knn.rebind(self.model(), volume);
    self.observer->setTopologies(volume, surface);
  } else {
    self.observer = std::make_unique<FrameObserver>(self.config, volume, surface);
  }
  self.prediction =
      std::make_unique<RigidPrediction>(volume.rest_vertices, self.observer->surface().pieces());
  self.placement.forgetModels();
  self.hold = std::make_unique<PositionPrior>(volume);
  self.moving.clear();
  self.held.reset();
  if (!edited) self.reset();
}

bool BodyTracker::ready() const { return implementation_->observer != nullptr; }

void BodyTracker::reset() { implementation_->reset(); }

void BodyTracker::restart(const Eigen::Isometry3d& rough_pose) {
  if (!ready()) throw std::logic_error("the topologies of simulator and surface have not come yet");
  implementation_->reset();
  implementation_->placement.startNear(rough_pose);
}

void BodyTracker::Implementation::reset() {
  placement.reset();
  if (observer != nullptr) observer->reset();
  if (prediction != nullptr) prediction->reset();
  last_stamp = 0;
  moving.clear();
  held.reset();
  knn.reset();
}

bool BodyTracker::Implementation::answers(const MeshState* volume, Nanoseconds stamp) const {
  return volume != nullptr && volume->observed >= placement.since() && volume->observed <= stamp &&
         volume->revision == model().revision && volume->vertices.rows() == model().rest_vertices.rows();
}

/// The volume's vertices in the fixed frame. @param answer nullptr where there is none.
Points BodyTracker::Implementation::predict(const RgbdFrame& frame, const MeshState* answer) {
  if (answer == nullptr) return transformed(model().rest_vertices, placement.pose());
  prediction->observe(answer->vertices, answer->observed);
  return prediction->at(frame.stamp, moving);
}

std::vector<Association> BodyTracker::Implementation::all(const Observation& seen,
                                                          const Eigen::Matrix3d& R_camera_fixed) const {
  if (config.knn_targets)
    return knn.associations(observer->map().features(), seen.matches, observer->surface(), R_camera_fixed);
  std::vector<Association> associations = inliers(seen.matches);
  if (config.use_depth) {
    associations.reserve(associations.size() + seen.depth.associations.size() + seen.outline.size());
    associations.insert(associations.end(), seen.depth.associations.begin(), seen.depth.associations.end());
    associations.insert(associations.end(), seen.outline.begin(), seen.outline.end());
  }
  return associations;
}

TrackingResult BodyTracker::Implementation::waiting(const std::string& reason) const {
  TrackingResult result;
  const bool recovering = placement.recovering();
  result.status.state = recovering ? TrackingState::kRecovering : TrackingState::kInitializing;
  result.status.reason = reason;
  // A body that was lost is simulated on without targets.
  result.has_targets = recovering;
  result.targets.body_pose = placement.pose();
  if (observer != nullptr) result.targets.revision = model().revision;
  return result;
}

TrackingStatus BodyTracker::Implementation::judge(const Observation& seen,
                                                  const std::vector<Association>& associations) {
  TrackingStatus status = statusOf(seen, associations);
  status.features_total = static_cast<std::uint32_t>(observer->map().features().size());
  placement.heed(status.state == TrackingState::kLost);
  if (status.state == TrackingState::kTracking && placement.alike() > 1)
    status.reason = "tracked in one of " + std::to_string(placement.alike()) + " poses that look alike";
  return status;
}

void BodyTracker::Implementation::admit(const RgbdFrame& frame, const Observation& seen) {
  const bool bind = observer->map().features().empty();
  observer->admit(frame, seen);
  if (!bind) return;
  knn.bind(observer->map().features(), model(),
           transformed(observer->surface().volumeVertices(), frame.T_fixed_camera));
}

/// Of what is seen; what lasts goes into the next frame's prediction.
TrackingResult BodyTracker::Implementation::resultOf(const RgbdFrame& frame, const Observation& seen,
                                                     const MeshState* answer) {
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  const Points& found = observer->surface().volumeVertices();
  placement.follow(frame.T_fixed_camera * fitRigid(model().rest_vertices, found));
  const std::vector<Association> associations = all(seen, T_camera_fixed.linear());
  TrackingResult result;
  result.status = judge(seen, associations);
  result.features = trackedFeatures(seen, observer->map().features(), T_camera_fixed);
  result.has_targets = true;
  result.targets = {model().revision, answer == nullptr, placement.pose(),
                    targetsOf(associations, frame.T_fixed_camera)};
  moving = seen.atLeast(Shows::kWell);
  const bool lost = result.status.state == TrackingState::kLost;
  if (answer != nullptr && !lost) {
    holdUnseen(seen, observer->surface().pieces(), answer->vertices, transformed(found, frame.T_fixed_camera),
               *hold, &result.targets.targets);
  }
  if (lost) prediction->reset();
  return result;
}

TrackingResult BodyTracker::track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer) {
  Implementation& self = *implementation_;
  requireCameraSize(frame);
  if (!ready()) return self.waiting("waiting for the topologies of simulator and surface");
  if (frame.stamp < self.last_stamp) self.reset();
  self.last_stamp = frame.stamp;
  const BodyPlacement::Found found = self.placement.find(frame, self.observer.get(), timer);
  if (found == BodyPlacement::Found::kNowhere) {
    return self.waiting(
        "the body was not found: nothing of its size and shape stands free in the depth image");
  }
  const bool anew = found == BodyPlacement::Found::kAnew;
  if (anew) self.prediction->reset();

  const auto scope = timer->stage("Feature-Point Tracking", anew);
  const MeshState* answer = !anew && self.answers(volume, frame.stamp) ? volume : nullptr;
  const Points predicted = transformed(self.predict(frame, answer), frame.T_fixed_camera.inverse());
  const Observation seen = self.observer->observe(frame, predicted);
  TrackingResult result = self.resultOf(frame, seen, answer);
  const bool learns = result.status.state == TrackingState::kTracking;
  self.held.tell(seen, self.observer->surface().surfaceBodies(), &result.status);
  if (learns) {
    self.admit(frame, seen);
    result.status.features_total = static_cast<std::uint32_t>(self.observer->map().features().size());
  }
  return result;
}

}  // namespace softbody
