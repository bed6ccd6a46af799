#include "softbody_tracking/body_tracker.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "color_model.h"
#include "depth_associations.h"
#include "feature_map.h"
#include "knn_targets.h"
#include "orb_extractor.h"
#include "predicted_surface.h"
#include "registration.h"
#include "rigid_prediction.h"
#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr int kRigidIterations = 5;
constexpr int kPatchMargin = 32;            // [px] around features for their descriptors and patches
constexpr double kRigidConvergence = 3e-4;  // [m]
constexpr double kLearnTolerance = 0.008;   // [m], depth agrees well enough to learn the body's colours
constexpr double kLookAgain = 0.004;        // [m] of any vertex; a rough step beyond it is rendered again
constexpr int kFewestAssociations = 12;
constexpr double kDegradedShare = 0.3;  // of the visible surface that must be explained
constexpr int kFewestExpectedFeatures =
    30;                                // with so many expected, hardly any found says that they are covered
constexpr double kFewestFound = 0.05;  // of the expected features
constexpr double kWorstInlierRatio = 0.2;
constexpr double kLargestRigidStep = 0.1;  // [m] of any vertex; more is no tracking
constexpr double kEnoughAligned = 0.5;  // of the expected features; with fewer, descriptors are matched too
constexpr int kFramesBetweenAdmissions = 10;  // of new features
constexpr int kLostFramesBeforeRecovery = 10;
constexpr int kFramesBetweenRegistrations = 10;  // it takes about a second

/// A feature's image position says where it is across its ray; how far along it, the depth around says
/// better. Two directions across the ray, each an association.
void addAcrossRay(const Association& feature, std::vector<Association>* associations) {
  const Eigen::Vector3d ray = feature.measured.normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(ray).normalized();
  for (const Eigen::Vector3d& normal : {right, Eigen::Vector3d(ray.cross(right))}) {
    associations->push_back(feature);
    associations->back().normal = normal;
  }
}

std::vector<Association> inliers(const std::vector<FeatureMatch>& matches) {
  std::vector<Association> result;
  for (const FeatureMatch& match : matches) {
    if (match.inlier) addAcrossRay(match.association, &result);
  }
  return result;
}

std::string sizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Target toTarget(const Association& a) { return {a.kind, a.place, a.measured, a.normal, a.weight}; }

}  // namespace

struct BodyTracker::Implementation {
  explicit Implementation(const TrackerConfig& tracker_config)
      : config(tracker_config), orb(config.features.max_features), map(config.features), knn(config.knn) {}

  /// What this frame's images gave against the prediction.
  struct Observation {
    std::vector<Keypoint> keypoints;
    std::vector<FeatureMatch> matches;
    DepthAssociations depth;
  };

  bool start(const RgbdFrame& frame, StageTimer* timer);
  /// Whether a state of the volume answers the targets sent since the body was placed.
  bool answers(const MeshState* volume, Nanoseconds stamp) const;
  Observation observe(const RgbdFrame& frame, const Points& vertices, bool first);
  void look(const RgbdFrame& frame, const Points& vertices);
  cv::Rect searchRegion(const cv::Size& size) const;
  std::vector<FeatureMatch> alignFeatures(const RgbdFrame& frame);
  bool few(const std::vector<FeatureMatch>& matches) const;
  std::vector<FeatureMatch> followFeatures(const RgbdFrame& frame);
  Eigen::Isometry3d rigidMotion(const RgbdFrame& frame, const std::vector<FeatureMatch>& matches) const;
  double largestMotion(const Eigen::Isometry3d& motion) const;
  void learnColors(const RgbdFrame& frame);
  std::vector<Association> all(const Observation& seen) const;
  std::vector<TrackedFeature> trackedFeatures(const Observation& seen) const;
  TrackingStatus judge(const Observation& seen, const std::vector<Association>& associations);
  TrackingResult waiting(const std::string& reason) const;
  void reset();

  TrackerConfig config;
  OrbExtractor orb;
  GrayPyramid pyramid;
  FeatureMap map;
  KnnTargets knn;
  ColorModel colors;
  std::unique_ptr<PredictedSurface> surface;
  SurfaceSamples samples;  ///< of the prediction
  std::unique_ptr<RigidPrediction> prediction;
  TriangleMesh rest_surface;
  double volume_edge_m = 0.0;

  bool registered = false;
  bool recovering = false;
  Eigen::Isometry3d body_pose = Eigen::Isometry3d::Identity();
  Nanoseconds placed_since = 0;  ///< stamp of the frame that placed the body; older states do not count
  Nanoseconds last_stamp = 0;
  int lost_frames = 0;
  int frames_to_registration = 0;
  int frames_to_admission = 0;
};

BodyTracker::BodyTracker(const TrackerConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}
BodyTracker::~BodyTracker() = default;

void BodyTracker::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  Implementation& self = *implementation_;
  self.surface = std::make_unique<PredictedSurface>(volume, surface);
  self.prediction = std::make_unique<RigidPrediction>(volume.rest_vertices);
  self.rest_surface = {surface.rest_vertices, surface.triangles};
  self.volume_edge_m = meanEdgeLength(volume.rest_vertices, volume.tets);
  self.reset();
}

bool BodyTracker::ready() const { return implementation_->surface != nullptr; }

void BodyTracker::reset() { implementation_->reset(); }

void BodyTracker::Implementation::reset() {
  registered = recovering = false;
  if (surface != nullptr) body_pose = surface->volume().initial_pose;
  if (prediction != nullptr) prediction->reset();
  last_stamp = 0;
  lost_frames = frames_to_registration = 0;
  map.reset();
  knn.reset();
  colors.reset();
}

bool BodyTracker::Implementation::start(const RgbdFrame& frame, StageTimer* timer) {
  if (frames_to_registration-- > 0) return false;
  frames_to_registration = kFramesBetweenRegistrations;
  const auto scope = timer->stage("Model Registration", true);
  const RegistrationResult found = registerBody(frame, rest_surface, body_pose, config.registration);
  if (found.cost > config.registration.max_cost) return false;
  body_pose = found.pose;
  registered = true;
  frames_to_registration = 0;
  placed_since = frame.stamp;
  return true;
}

bool BodyTracker::Implementation::answers(const MeshState* volume, Nanoseconds stamp) const {
  return volume != nullptr && volume->observed >= placed_since && volume->observed <= stamp &&
         volume->revision == surface->volume().revision &&
         volume->vertices.rows() == surface->volume().rest_vertices.rows();
}

void BodyTracker::Implementation::learnColors(const RgbdFrame& frame) {
  const cv::Mat1f& rendered = surface->image().depth;
  cv::Mat1b mask(rendered.size(), 0);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const bool agrees =
          rendered(v, u) > 0.0f && std::abs(rendered(v, u) - frame.depth(v, u)) < kLearnTolerance;
      mask(v, u) = agrees ? 255 : 0;
    }
  }
  cv::erode(mask, mask, cv::Mat());
  colors.learn(frame.color, mask);
}

/// Renders and samples the prediction.
void BodyTracker::Implementation::look(const RgbdFrame& frame, const Points& vertices) {
  surface->update(frame.camera, vertices);
  samples = sampleSurface(*surface, config.depth.max_targets);
}

/// The rigid motion that the depth and the features ask of the prediction.
Eigen::Isometry3d BodyTracker::Implementation::rigidMotion(const RgbdFrame& frame,
                                                           const std::vector<FeatureMatch>& matches) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  for (int i = 0; i < kRigidIterations; ++i) {
    const DepthAssociations depth =
        associateDepth(frame, surface->image(), samples, motion, colors, volume_edge_m, config.depth);
    std::vector<Association> associations = inliers(matches);
    for (Association& association : associations) association.predicted = motion * association.predicted;
    associations.insert(associations.end(), depth.associations.begin(), depth.associations.end());
    if (static_cast<int>(associations.size()) < kFewestAssociations) break;
    const Eigen::Isometry3d step = rigidStep(associations);
    const double moved = largestMotion(step);
    if (moved > kLargestRigidStep) break;
    motion = step * motion;
    if (moved < kRigidConvergence) break;
  }
  return motion;
}

/// How far a rigid motion takes any vertex of the prediction [m].
double BodyTracker::Implementation::largestMotion(const Eigen::Isometry3d& motion) const {
  const Points& vertices = surface->volumeVertices();
  return (transformed(vertices, motion) - vertices).rowwise().norm().maxCoeff();
}

cv::Rect BodyTracker::Implementation::searchRegion(const cv::Size& size) const {
  const int margin = config.features.search_radius_px + kPatchMargin;
  const cv::Rect& covered = surface->image().region;
  if (covered.empty()) return {};
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         cv::Rect(cv::Point(), size);
}

std::vector<FeatureMatch> BodyTracker::Implementation::alignFeatures(const RgbdFrame& frame) {
  pyramid.build(frame.color, searchRegion(frame.color.size()));
  return map.align(frame, pyramid, *surface);
}

bool BodyTracker::Implementation::few(const std::vector<FeatureMatch>& matches) const {
  return static_cast<double>(matches.size()) < kEnoughAligned * map.expected();
}

/// Features around the prediction; where most are not there, around the prediction moved to the depth.
std::vector<FeatureMatch> BodyTracker::Implementation::followFeatures(const RgbdFrame& frame) {
  std::vector<FeatureMatch> matches = alignFeatures(frame);
  if (!few(matches)) return matches;
  const Eigen::Isometry3d rough = rigidMotion(frame, matches);
  if (largestMotion(rough) < kLookAgain) return matches;
  look(frame, transformed(surface->volumeVertices(), rough));
  return alignFeatures(frame);
}

BodyTracker::Implementation::Observation BodyTracker::Implementation::observe(const RgbdFrame& frame,
                                                                              const Points& vertices,
                                                                              bool first) {
  Observation seen;
  look(frame, vertices);
  if (first) learnColors(frame);
  seen.matches = followFeatures(frame);
  if (first || few(seen.matches) || frames_to_admission-- <= 0) {
    frames_to_admission = kFramesBetweenAdmissions;
    const cv::Rect region = searchRegion(frame.color.size());
    seen.keypoints = orb.extract(frame.color, colors.mask(frame.color, region), region);
    if (few(seen.matches)) map.search(frame, pyramid, seen.keypoints, *surface, &seen.matches);
  }
  map.judge(frame.camera, &seen.matches);
  const Eigen::Isometry3d motion = rigidMotion(frame, seen.matches);
  seen.depth = associateDepth(frame, surface->image(), samples, motion, colors, volume_edge_m, config.depth);
  surface->move(motion);
  for (FeatureMatch& match : seen.matches) match.association.predicted = motion * match.association.predicted;
  body_pose = fitRigid(surface->volume().rest_vertices, surface->volumeVertices());
  return seen;
}

std::vector<Association> BodyTracker::Implementation::all(const Observation& seen) const {
  std::vector<Association> associations =
      config.knn_targets ? knn.associations(map.features(), seen.matches, surface->volumeVertices())
                         : inliers(seen.matches);
  if (config.use_depth && !config.knn_targets) {
    associations.insert(associations.end(), seen.depth.associations.begin(), seen.depth.associations.end());
  }
  return associations;
}

std::vector<TrackedFeature> BodyTracker::Implementation::trackedFeatures(const Observation& seen) const {
  std::vector<TrackedFeature> result;
  for (const FeatureMatch& match : seen.matches) {
    if (!match.inlier) continue;
    const MapFeature& feature = map.features()[match.feature];
    const cv::Point2f pixel = match.pixel;
    const double confidence =
        feature.predicted > 0 ? static_cast<double>(feature.matched) / feature.predicted : 0.0;
    result.push_back(
        {feature.id, {pixel.x, pixel.y}, match.association.measured, feature.reference, confidence});
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
  if (surface != nullptr) result.targets.revision = surface->volume().revision;
  return result;
}

TrackingStatus BodyTracker::Implementation::judge(const Observation& seen,
                                                  const std::vector<Association>& associations) {
  TrackingStatus status;
  const auto kept = static_cast<double>(std::count_if(seen.matches.begin(), seen.matches.end(),
                                                      [](const FeatureMatch& m) { return m.inlier; }));
  status.features_tracked = static_cast<std::uint32_t>(kept);
  status.features_total = static_cast<std::uint32_t>(map.features().size());
  status.inlier_ratio = seen.matches.empty() ? 0.0 : kept / static_cast<double>(seen.matches.size());
  status.residual_rms = rmsResidual(associations);
  const int visible = seen.depth.visible_blocks;
  const auto explained = static_cast<double>(seen.depth.associations.size());
  if (static_cast<int>(explained + kept) < kFewestAssociations) {
    ++lost_frames;
    status.state = TrackingState::kLost;
    status.reason = visible == 0 ? "the body is out of view or nothing is measured there"
                                 : "neither depth nor features agree with the prediction";
    return status;
  }
  lost_frames = 0;
  recovering = false;
  status.state = TrackingState::kTracking;
  if (explained < kDegradedShare * visible) {
    status.state = TrackingState::kDegraded;
    status.reason = seen.depth.occluded_blocks > seen.depth.absent_blocks
                        ? "most of the body is occluded"
                        : "most of the body is not where predicted";
  } else if (map.expected() >= kFewestExpectedFeatures && kept < kFewestFound * map.expected()) {
    status.state = TrackingState::kDegraded;
    status.reason = "hardly any of the expected features are found";
  } else if (static_cast<int>(seen.matches.size()) >= kFewestExpectedFeatures &&
             status.inlier_ratio < kWorstInlierRatio) {
    status.state = TrackingState::kDegraded;
    status.reason = "most feature matches disagree with their neighbours";
  }
  return status;
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
  if (self.lost_frames >= kLostFramesBeforeRecovery) {
    self.registered = false;
    self.recovering = true;
    self.lost_frames = 0;
  }
  const bool first = !self.registered;
  if (first && !self.surface->volume().has_initial_pose) {
    return self.waiting("no initial pose: give object.initial_pose in the object's YAML file");
  }
  if (first && !self.start(frame, timer)) return self.waiting("the body was not found near its rough pose");

  TrackingResult result;
  const auto scope = timer->stage("Feature-Point Tracking", first);
  const bool placed = !first && self.answers(volume, frame.stamp);
  if (placed) self.prediction->observe(volume->vertices, volume->observed);
  const Points predicted = placed ? transformed(volume->vertices, self.prediction->motionUntil(frame.stamp))
                                  : transformed(self.surface->volume().rest_vertices, self.body_pose);
  const Implementation::Observation seen = self.observe(frame, predicted, first);
  const std::vector<Association> associations = self.all(seen);
  result.status = self.judge(seen, associations);
  result.features = self.trackedFeatures(seen);
  result.has_targets = true;
  result.targets.revision = self.surface->volume().revision;
  result.targets.reset = !placed;
  result.targets.body_pose = self.body_pose;
  for (const Association& association : associations) result.targets.targets.push_back(toTarget(association));
  if (result.status.state == TrackingState::kLost) self.prediction->reset();
  if (result.status.state == TrackingState::kTracking) {
    const bool bind = self.map.features().empty();
    if (!seen.keypoints.empty())
      self.map.admit(frame, self.pyramid, seen.keypoints, seen.matches, *self.surface);
    if (bind) self.knn.bind(self.map.features(), self.surface->volume(), self.surface->volumeVertices());
    result.status.features_total = static_cast<std::uint32_t>(self.map.features().size());
  }
  return result;
}

}  // namespace softbody
