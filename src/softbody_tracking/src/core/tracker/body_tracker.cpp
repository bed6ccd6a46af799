#include "softbody_tracking/tracker/body_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "alignment/measured_share.h"
#include "alignment/rigid_alignment.h"
#include "prediction/rigid_prediction.h"
#include "prediction/topology_check.h"
#include "search_report/search_sentence.h"
#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/same_matrix.h"
#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/time/time.h"
#include "status/disagreement.h"
#include "tracker/body_search.h"
#include "tracker/frame_observer.h"
#include "tracker/tracking_status.h"
#include "tracker/tracking_targets.h"

namespace softbody {
namespace {

// Without a state for this long the simulator is not running, or far too slow: a step takes milliseconds.
constexpr Nanoseconds kLongestSilence = 1'000'000'000;

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireCameraSize(const RgbdFrame& frame) {
  const cv::Size size(frame.camera.width, frame.camera.height);
  if (frame.color.size() == size && frame.depth.size() == size) return;
  throw std::invalid_argument("colour is " + sizeText(frame.color.size()) + ", depth " +
                              sizeText(frame.depth.size()) + ", but the camera " + sizeText(size));
}

/// Of a state of the volume. @param answer nullptr: not known.
const std::vector<float>& deviationsOf(const MeshState* answer) {
  static const std::vector<float> kUnknown;
  return answer != nullptr ? answer->standard_deviation : kUnknown;
}

/// Features, depth and outline.
std::vector<Association> associationsOf(const Observation& seen) {
  std::vector<Association> associations = inliers(seen.matches);
  for (const std::vector<Association>* more : {&seen.depth.associations, &seen.outline.associations})
    associations.insert(associations.end(), more->begin(), more->end());
  return associations;
}

}  // namespace

struct BodyTracker::Implementation {
  Implementation(const TrackerConfig& tracker_config, const cv::Mat3b& picture)
      : config(tracker_config), search(config.registration, picture) {}

  TrackingResult track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer,
                       const UseTargets& use);
  void setTopologies(const TetTopology& volume, const MeshTopology& surface);
  bool hasTopologies(const TetTopology& volume, const MeshTopology& surface) const;
  bool isEdit(const TetTopology& volume, const MeshTopology& surface) const;
  void reset();

  const TetTopology& model() const { return observer->model().volume(); }
  std::uint32_t knownFeatures() const { return static_cast<std::uint32_t>(observer->features().size()); }
  void forgetMotion(bool searched);
  bool isAnswer(const MeshState* volume) const;
  Points predict(const RgbdFrame& frame, const MeshState* answer);
  TrackingStatus judge(const RgbdFrame& frame, const ObservedBody& observed,
                       const std::vector<Association>& associations, const MeshState* answer);
  TrackingStatus withSilence(TrackingStatus status) const;
  TargetSet targetSetOf(const RgbdFrame& frame, const ObservedBody& observed,
                        const std::vector<Association>& associations, const MeshState* answer) const;
  TrackingResult waiting(const std::string& reason, const UseTargets& use) const;

  TrackerConfig config;
  BodySearch search;
  std::unique_ptr<FrameObserver> observer;
  std::unique_ptr<RigidPrediction> prediction;
  std::vector<MaterialPoint> places;  ///< vertexPlaces() of the model
  HeldPieces held;
  MeanDisagreement disagreement;
  std::vector<MotionShare> measured;  ///< share of each piece's motion in the last frame; empty: all
  Nanoseconds stamp = 0;              ///< of the present frame
  Nanoseconds last_answer = 0;        ///< stamp of the last state that was an answer
  int pass = 0;                       ///< of the last frame
};

TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& why) {
  TrackingStatus status;
  status.state = last.state == TrackingState::kTracking ? TrackingState::kDegraded : last.state;
  status.features_total = last.features_total;
  status.reason = "frame skipped: " + why;
  return status;
}

TrackingStatus skippedFrame(const TrackingStatus& last, const std::string& camera_frame,
                            const std::string& output_frame, const std::string& why) {
  return skippedFrame(last, fmt::format("tf does not say where {} is in output_frame {}: {}", camera_frame,
                                        output_frame, why));
}

TrackingStatus withoutImages(const TrackingStatus& last, const std::optional<double>& silence_s) {
  TrackingStatus status;
  status.state = last.state == TrackingState::kInitializing ? last.state : TrackingState::kLost;
  status.features_total = last.features_total;
  status.reason =
      silence_s ? fmt::format("no image for {:.0f} s", *silence_s) : "waiting for the first image";
  return status;
}

BodyTracker::BodyTracker(const TrackerConfig& config, const cv::Mat3b& picture)
    : implementation_(std::make_unique<Implementation>(config, picture)) {}
BodyTracker::~BodyTracker() = default;

void BodyTracker::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  requireWhole(volume, surface);
  implementation_->setTopologies(volume, surface);
}

bool BodyTracker::ready() const { return implementation_->observer != nullptr; }

bool BodyTracker::isEdit(const TetTopology& volume, const MeshTopology& surface) const {
  return implementation_->isEdit(volume, surface);
}

void BodyTracker::setPicture(const cv::Mat3b& picture) { implementation_->search.setPicture(picture); }

void BodyTracker::reset() { implementation_->reset(); }

void BodyTracker::restart(const Eigen::Isometry3d& rough_pose) {
  if (!ready()) throw std::logic_error("the topologies of simulator and surface have not come yet");
  implementation_->reset();
  implementation_->search.startNear(rough_pose);
}

void BodyTracker::placeAt(const Eigen::Isometry3d& pose) {
  restart(pose);
  implementation_->search.placeAt(pose);
}

TrackingResult BodyTracker::track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer,
                                  const UseTargets& use) {
  requireCameraSize(frame);
  return implementation_->track(frame, volume, timer, use);
}

/// The steps of one frame.
TrackingResult BodyTracker::Implementation::track(const RgbdFrame& frame, const MeshState* volume,
                                                  StageTimer* timer, const UseTargets& use) {
  if (observer == nullptr) return waiting("waiting for the topologies of simulator and surface", use);
  if (frame.pass != pass || frame.stamp < stamp) reset();
  pass = frame.pass;
  stamp = frame.stamp;
  const BodySearch::Outcome outcome = search.locate(frame, observer.get(), timer);
  if (outcome == BodySearch::Outcome::kNotFound) return waiting(whyNotFound(search.report()), use);
  const bool just_found = outcome != BodySearch::Outcome::kTracked;
  if (just_found) forgetMotion(outcome == BodySearch::Outcome::kFound);

  const auto scope = timer->stage("Feature-Point Tracking", just_found);
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  const MeshState* answer = !just_found && isAnswer(volume) ? volume : nullptr;
  if (answer != nullptr) last_answer = answer->observed;
  const Points predicted = transformed(predict(frame, answer), T_camera_fixed);
  const ObservedBody observed = observer->observe(frame, predicted);
  const auto& [seen, surface, image, labels] = observed;
  search.setPose(frame.T_fixed_camera * fitRigid(model().rest_vertices, surface.volumeVertices()));
  const std::vector<Association> associations = associationsOf(seen);
  measured = measuredShares(associations, surface.pieceVertices(), frame.T_fixed_camera.linear());

  TrackingResult result;
  result.has_targets = true;
  result.status = judge(frame, observed, associations, answer);
  const TrackingState state = result.status.state;
  search.noteLoss(state == TrackingState::kLost, stamp);
  if (state == TrackingState::kLost) prediction->reset();
  result.targets =
      targetSetOf(frame, observed, associations, state == TrackingState::kLost ? nullptr : answer);
  result.targets.reset = answer == nullptr;
  if (use) use(result.targets);
  result.features = trackedFeatures(seen, observer->features(), T_camera_fixed);
  result.status = held.report(seen, surface.model().piecesOfSurface(), stamp, std::move(result.status));
  if (state == TrackingState::kTracking) observer->learnFeatures(frame, observed, deviationsOf(answer));
  result.status.features_total = knownFeatures();
  result.labels = labels.label;
  result.labelled = labels.region;
  return result;
}

void BodyTracker::setConfig(const TrackerConfig& config) {
  implementation_->config = config;
  if (implementation_->observer) implementation_->observer->setConfig(config);
}

void BodyTracker::Implementation::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  if (hasTopologies(volume, surface)) return;
  const bool edited = isEdit(volume, surface);
  if (edited) {
    observer->setTopologies(volume, surface);
    search.forgetMeshes();
  } else {
    observer = std::make_unique<FrameObserver>(config, volume, surface);
    search.prepareMeshes(surface);
  }
  prediction = std::make_unique<RigidPrediction>(volume.rest_vertices, observer->model().pieces());
  places = vertexPlaces(volume);
  measured.clear();
  held.reset();
  if (!edited) reset();
}

bool BodyTracker::Implementation::isEdit(const TetTopology& volume, const MeshTopology& surface) const {
  return observer != nullptr && volume.revision > model().revision && mayBeEditOf(model(), volume) &&
         mayBeEditOf(observer->model().surface(), surface);
}

/// A node that starts again sends what is known.
bool BodyTracker::Implementation::hasTopologies(const TetTopology& volume,
                                                const MeshTopology& surface) const {
  if (observer == nullptr) return false;
  const MeshTopology& known = observer->model().surface();
  return volume.revision == model().revision && sameMatrix(volume.rest_vertices, model().rest_vertices) &&
         sameMatrix(volume.tets, model().tets) && sameMatrix(surface.rest_vertices, known.rest_vertices) &&
         sameMatrix(surface.triangles, known.triangles);
}

void BodyTracker::Implementation::reset() {
  search.reset();
  if (observer != nullptr) observer->reset();
  if (prediction != nullptr) prediction->reset();
  last_answer = 0;
  measured.clear();
  held.reset();
  disagreement.reset();
}

/// The body did not move to where it is found: the frames before say nothing about the next one.
void BodyTracker::Implementation::forgetMotion(bool searched) {
  disagreement.reset();
  prediction->reset();
  observer->foundAgain(searched);
}

/// Whether a state of the volume answers targets that were sent since the body was found. A state far from
/// the tracked pose does not: targets with reset bring that body back.
bool BodyTracker::Implementation::isAnswer(const MeshState* volume) const {
  return volume != nullptr && volume->observed >= search.foundAt() && volume->observed <= stamp &&
         volume->revision == model().revision &&
         isWithinReach(volume->vertices, transformed(model().rest_vertices, search.pose()),
                       reachOf(model().rest_vertices));
}

/// The volume's vertices at the frame's stamp, fixed frame. @param answer nullptr without one.
Points BodyTracker::Implementation::predict(const RgbdFrame& frame, const MeshState* answer) {
  if (answer == nullptr) return transformed(model().rest_vertices, search.pose());
  prediction->observe(answer->vertices, answer->observed);
  return prediction->at(frame.stamp, measured);
}

TrackingResult BodyTracker::Implementation::waiting(const std::string& reason, const UseTargets& use) const {
  TrackingResult result;
  const bool recovering = search.recovering();
  result.status.state = recovering ? TrackingState::kRecovering : TrackingState::kInitializing;
  result.status.reason = reason;
  // A lost body is simulated without targets.
  result.has_targets = recovering;
  result.targets.body_pose = search.pose();
  if (observer != nullptr) result.targets.revision = model().revision;
  if (result.has_targets && use) use(result.targets);
  return result;
}

/// @param answer state of the volume before the frame, or nullptr.
TrackingStatus BodyTracker::Implementation::judge(const RgbdFrame& frame, const ObservedBody& observed,
                                                  const std::vector<Association>& associations,
                                                  const MeshState* answer) {
  const auto& [seen, surface, image, labels] = observed;
  const std::vector<float>& deviations = deviationsOf(answer);
  const ComparedBody compared{labels, surface, frame.depth, seen.outline.deviation_px, deviations};
  const ShownError error{disagreement.add(largestDisagreement(compared), stamp),
                         medianBound(associations, model(), deviations), imageScale(labels, surface)};
  TrackingStatus status = statusOf(seen, associations, error, config.status_tolerance_m);
  if (status.state == TrackingState::kTracking && search.alike() > 1) {
    const std::string other = status.reason;
    status.reason = alikeReason(search.alike());
    if (!other.empty()) status.reason += "; " + other;
  }
  return withSilence(std::move(status));
}

/// Without states of the simulator the prediction is a guess, however well the frame agrees with it.
TrackingStatus BodyTracker::Implementation::withSilence(TrackingStatus status) const {
  const Nanoseconds silence = stamp - std::max(last_answer, search.foundAt());
  if (silence <= kLongestSilence || status.state == TrackingState::kLost) return status;
  const std::string reason = fmt::format(
      "no state from the simulator for {:.1f} s: it is not running, or too slow", seconds(silence));
  status.state = TrackingState::kDegraded;
  status.reason = status.reason.empty() ? reason : reason + "; " + status.reason;
  return status;
}

/// @param answer state of the volume in which pieces without measurements are held; nullptr: no piece is
/// held.
TargetSet BodyTracker::Implementation::targetSetOf(const RgbdFrame& frame, const ObservedBody& observed,
                                                   const std::vector<Association>& associations,
                                                   const MeshState* answer) const {
  TargetSet set;
  set.revision = model().revision;
  set.body_pose = search.pose();
  set.targets = targetsOf(associations, frame.T_fixed_camera);
  if (answer == nullptr) return set;
  const PredictedSurface& surface = observed.surface;
  addHeldPieces(observed.seen, surface.model().pieces(), answer->vertices,
                transformed(surface.volumeVertices(), frame.T_fixed_camera), places, &set.targets);
  return set;
}

}  // namespace softbody
