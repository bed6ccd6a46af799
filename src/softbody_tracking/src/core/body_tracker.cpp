#include "softbody_tracking/body_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "frame_observer.h"
#include "knn_targets.h"
#include "localizer.h"
#include "piece_hold.h"
#include "rigid_prediction.h"
#include "softbody_common/rigid_fit.h"
#include "tracking_status.h"

namespace softbody {
namespace {

constexpr int kLostFramesBeforeRecovery = 10;
constexpr int kFramesBetweenRegistrations = 10;  // it takes about a second

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void requireTets(const TetTopology& volume) {
  if (volume.tets.rows() == 0) throw std::invalid_argument("the volume's topology has no tet");
  const Eigen::Index count = volume.rest_vertices.rows();
  for (const int vertex : {volume.tets.minCoeff(), volume.tets.maxCoeff()}) {
    if (vertex < 0 || vertex >= count) {
      throw std::invalid_argument(
          fmt::format("a tet of the volume's topology names vertex {} of {}", vertex, count));
    }
  }
}

Target toTarget(const Association& a, const Eigen::Isometry3d& T_fixed_camera) {
  return {a.kind, a.place, T_fixed_camera * a.measured, T_fixed_camera.linear() * a.normal, a.weight};
}

}  // namespace

struct BodyTracker::Implementation {
  explicit Implementation(const TrackerConfig& tracker_config) : config(tracker_config), knn(config.knn) {}

  void takeInitialPose(const RgbdFrame& frame);
  bool start(const RgbdFrame& frame, StageTimer* timer);
  bool recognize(const RgbdFrame& frame, StageTimer* timer);
  const Localizer& findingLocalizer();
  void place(const RgbdFrame& frame, const Localization& found);
  /// Whether a state of the volume answers the targets sent since the body was placed.
  bool answers(const MeshState* volume, Nanoseconds stamp) const;
  std::vector<Association> all(const Observation& seen, const Eigen::Matrix3d& R_camera_fixed) const;
  std::vector<TrackedFeature> trackedFeatures(const Observation& seen,
                                              const Eigen::Isometry3d& T_camera_fixed) const;
  TrackingStatus judge(const Observation& seen, const std::vector<Association>& associations);
  void admit(const RgbdFrame& frame, const Observation& seen);
  void holdUnseen(const Observation& seen, const Points& vertices, const Eigen::Isometry3d& T_fixed_camera,
                  std::vector<Target>* targets) const;
  TrackingResult waiting(const std::string& reason) const;
  void reset();

  TrackerConfig config;
  KnnTargets knn;
  std::unique_ptr<FrameObserver> observer;
  std::unique_ptr<RigidPrediction> prediction;
  std::unique_ptr<Localizer> localizer;  ///< null until it is needed: no frame waits for it after a cut
  std::unique_ptr<PieceHold> hold;
  HeldPieces held;
  std::vector<bool> moving;  ///< pieces whose velocity is known well enough to go on with; none: all

  bool fresh = true;  ///< no frame since the last reset
  bool registered = false;
  bool recovering = false;
  int poses_alike = 1;                          ///< of the last registration
  std::optional<Eigen::Isometry3d> given_pose;  ///< rough, by the object's file or by restart(); fixed frame
  Eigen::Isometry3d body_pose = Eigen::Isometry3d::Identity();  ///< fixed frame
  Nanoseconds placed_since = 0;  ///< stamp of the frame that placed the body; older states do not count
  Nanoseconds last_stamp = 0;
  int lost_frames = 0;
  int frames_to_registration = 0;
  int frames_to_recognition = 0;  ///< after one that registration refused
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
  requireTets(volume);
  Implementation& self = *implementation_;
  const bool edited =
      self.observer != nullptr && volume.revision > self.observer->surface().volume().revision;
  if (edited) {
    self.knn.rebind(self.observer->surface().volume(), volume);
    self.observer->setTopologies(volume, surface);
  } else {
    self.observer = std::make_unique<FrameObserver>(self.config, volume, surface);
  }
  self.prediction =
      std::make_unique<RigidPrediction>(volume.rest_vertices, self.observer->surface().pieces());
  self.localizer.reset();
  self.hold = std::make_unique<PieceHold>(volume);
  self.moving.clear();
  self.held.reset();
  if (!edited) self.reset();
}

bool BodyTracker::ready() const { return implementation_->observer != nullptr; }

void BodyTracker::reset() { implementation_->reset(); }

void BodyTracker::restart(const Eigen::Isometry3d& rough_pose) {
  if (!ready()) throw std::logic_error("the topologies of simulator and surface have not come yet");
  implementation_->reset();
  implementation_->fresh = false;
  implementation_->given_pose = implementation_->body_pose = rough_pose;
}

void BodyTracker::Implementation::reset() {
  fresh = true;
  registered = recovering = false;
  given_pose.reset();
  if (observer != nullptr) observer->reset();
  if (prediction != nullptr) prediction->reset();
  last_stamp = 0;
  lost_frames = frames_to_registration = frames_to_recognition = 0;
  moving.clear();
  held.reset();
  knn.reset();
}

/// The object's file says where the body is before the camera as it stands at the start.
void BodyTracker::Implementation::takeInitialPose(const RgbdFrame& frame) {
  const TetTopology& volume = observer->surface().volume();
  body_pose = frame.T_fixed_camera * volume.initial_pose;
  if (volume.has_initial_pose) given_pose = body_pose;
  fresh = false;
}

const Localizer& BodyTracker::Implementation::findingLocalizer() {
  if (localizer == nullptr) {
    const MeshTopology& surface = observer->surface().topology();
    localizer = std::make_unique<Localizer>(TriangleMesh{surface.rest_vertices, surface.triangles},
                                            config.registration);
  }
  return *localizer;
}

void BodyTracker::Implementation::place(const RgbdFrame& frame, const Localization& found) {
  body_pose = frame.T_fixed_camera * found.pose;
  poses_alike = found.alike;
  registered = true;
  prediction->reset();
  lost_frames = frames_to_registration = frames_to_recognition = 0;
  placed_since = frame.stamp;
}

/// Finds a body that was lost by its features, as soon as they are seen again.
bool BodyTracker::Implementation::recognize(const RgbdFrame& frame, StageTimer* timer) {
  if (frames_to_recognition-- > 0) return false;
  const std::optional<Eigen::Isometry3d> rough = observer->recognize(frame);
  frames_to_recognition = rough ? kFramesBetweenRegistrations : 0;
  if (!rough) return false;
  const auto scope = timer->stage("Model Registration", true);
  const std::optional<Localization> found = findingLocalizer().recognized(
      frame, *rough, [&](const Eigen::Isometry3d& pose) { return observer->featureShare(frame, pose); });
  if (found) place(frame, *found);
  return found.has_value();
}

/// Finds the body where nothing predicts it: near the pose that the user gave, or anywhere.
bool BodyTracker::Implementation::start(const RgbdFrame& frame, StageTimer* timer) {
  if (frames_to_registration-- > 0) return false;
  frames_to_registration = kFramesBetweenRegistrations;
  const auto scope = timer->stage("Model Registration", true);
  const Localizer& finder = findingLocalizer();
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  std::optional<Localization> found;
  if (given_pose && !recovering) found = finder.near(frame, T_camera_fixed * *given_pose);
  if (!found) {
    std::vector<Eigen::Isometry3d> guesses;
    if (recovering || given_pose) guesses.push_back(T_camera_fixed * body_pose);
    found = finder.anywhere(frame, observer->colors(), guesses, [&](const Eigen::Isometry3d& pose) {
      return observer->featureShare(frame, pose);
    });
  }
  if (found) place(frame, *found);
  return found.has_value();
}

bool BodyTracker::Implementation::answers(const MeshState* volume, Nanoseconds stamp) const {
  return volume != nullptr && volume->observed >= placed_since && volume->observed <= stamp &&
         volume->revision == observer->surface().volume().revision &&
         volume->vertices.rows() == observer->surface().volume().rest_vertices.rows();
}

std::vector<Association> BodyTracker::Implementation::all(const Observation& seen,
                                                          const Eigen::Matrix3d& R_camera_fixed) const {
  std::vector<Association> associations =
      config.knn_targets
          ? knn.associations(observer->map().features(), seen.matches, observer->surface(), R_camera_fixed)
          : inliers(seen.matches);
  if (config.use_depth && !config.knn_targets) {
    associations.insert(associations.end(), seen.depth.associations.begin(), seen.depth.associations.end());
    associations.insert(associations.end(), seen.outline.begin(), seen.outline.end());
  }
  return associations;
}

std::vector<TrackedFeature> BodyTracker::Implementation::trackedFeatures(
    const Observation& seen, const Eigen::Isometry3d& T_camera_fixed) const {
  std::vector<TrackedFeature> result;
  for (const FeatureMatch& match : seen.matches) {
    if (!match.inlier) continue;
    const MapFeature& feature = observer->map().features()[match.feature];
    const cv::Point2f pixel = match.pixel;
    const double confidence =
        feature.predicted > 0 ? static_cast<double>(feature.matched) / feature.predicted : 0.0;
    result.push_back({feature.id,
                      {pixel.x, pixel.y},
                      match.association.measured,
                      T_camera_fixed * feature.reference,
                      confidence});
  }
  return result;
}

TrackingResult BodyTracker::Implementation::waiting(const std::string& reason) const {
  TrackingResult result;
  result.status.state = recovering ? TrackingState::kRecovering : TrackingState::kInitializing;
  result.status.reason = reason;
  // A body that was lost is simulated on without targets.
  result.has_targets = recovering;
  result.targets.body_pose = body_pose;
  if (observer != nullptr) result.targets.revision = observer->surface().volume().revision;
  return result;
}

TrackingStatus BodyTracker::Implementation::judge(const Observation& seen,
                                                  const std::vector<Association>& associations) {
  TrackingStatus status = statusOf(seen, associations);
  status.features_total = static_cast<std::uint32_t>(observer->map().features().size());
  const bool lost = status.state == TrackingState::kLost;
  lost_frames = lost ? lost_frames + 1 : 0;
  recovering = recovering && lost;
  if (status.state == TrackingState::kTracking && poses_alike > 1)
    status.reason = "tracked in one of " + std::to_string(poses_alike) + " poses that look alike";
  return status;
}

void BodyTracker::Implementation::admit(const RgbdFrame& frame, const Observation& seen) {
  const bool bind = observer->map().features().empty();
  observer->admit(frame, seen);
  if (!bind) return;
  knn.bind(observer->map().features(), observer->surface().volume(),
           transformed(observer->surface().volumeVertices(), frame.T_fixed_camera));
}

/// What hardly shows stays where the simulation had it: nothing tells where else it
/// is. What shows loosely goes as a whole where it was found. @param vertices of the simulation, fixed frame.
void BodyTracker::Implementation::holdUnseen(const Observation& seen, const Points& vertices,
                                             const Eigen::Isometry3d& T_fixed_camera,
                                             std::vector<Target>* targets) const {
  const std::vector<std::vector<int>>& pieces = observer->surface().pieces();
  const Points found = transformed(observer->surface().volumeVertices(), T_fixed_camera);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (seen.shown[p] == Shows::kWell) continue;
    const bool hardly = seen.shown[p] == Shows::kHardly;
    hold->add(pieces[p], hardly ? vertices : found, PieceHold::kWeak, targets);
  }
}

TrackingResult BodyTracker::track(const RgbdFrame& frame, const MeshState* volume, StageTimer* timer) {
  Implementation& self = *implementation_;
  const cv::Size size(frame.camera.width, frame.camera.height);
  if (frame.color.size() != size || frame.depth.size() != size) {
    throw std::invalid_argument("colour is " + sizeText(frame.color.size()) + ", depth " +
                                sizeText(frame.depth.size()) + ", but the camera " + sizeText(size));
  }
  if (!ready()) return self.waiting("waiting for the topologies of simulator and surface");
  if (frame.stamp < self.last_stamp) self.reset();
  self.last_stamp = frame.stamp;
  if (self.fresh) self.takeInitialPose(frame);
  if (self.lost_frames >= kLostFramesBeforeRecovery) {
    self.registered = false;
    self.recovering = true;
    self.lost_frames = 0;
  }
  const bool first = !self.registered;
  const bool recognized = self.recovering && self.recognize(frame, timer);
  if (first && !recognized && !self.start(frame, timer))
    return self.waiting(
        "the body was not found: nothing of its size and shape stands free in the depth image");

  TrackingResult result;
  const auto scope = timer->stage("Feature-Point Tracking", first);
  const bool placed = !first && self.answers(volume, frame.stamp);
  if (placed) self.prediction->observe(volume->vertices, volume->observed);
  const Points predicted = placed
                               ? self.prediction->at(frame.stamp, self.moving)
                               : transformed(self.observer->surface().volume().rest_vertices, self.body_pose);
  const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
  const Observation seen = self.observer->observe(frame, transformed(predicted, T_camera_fixed));
  self.body_pose = frame.T_fixed_camera * fitRigid(self.observer->surface().volume().rest_vertices,
                                                   self.observer->surface().volumeVertices());
  const std::vector<Association> associations = self.all(seen, T_camera_fixed.linear());
  result.status = self.judge(seen, associations);
  const bool learns = result.status.state == TrackingState::kTracking;
  self.held.tell(seen, self.observer->surface().surfaceBodies(), &result.status);
  result.features = self.trackedFeatures(seen, T_camera_fixed);
  result.has_targets = true;
  result.targets.revision = self.observer->surface().volume().revision;
  result.targets.reset = !placed;
  result.targets.body_pose = self.body_pose;
  result.targets.targets.reserve(associations.size());
  for (const Association& association : associations)
    result.targets.targets.push_back(toTarget(association, frame.T_fixed_camera));
  self.moving = seen.atLeast(Shows::kWell);
  const bool lost = result.status.state == TrackingState::kLost;
  if (placed && !lost) self.holdUnseen(seen, volume->vertices, frame.T_fixed_camera, &result.targets.targets);
  if (lost) self.prediction->reset();
  if (learns) {
    self.admit(frame, seen);
    result.status.features_total = static_cast<std::uint32_t>(self.observer->map().features().size());
  }
  return result;
}

}  // namespace softbody
