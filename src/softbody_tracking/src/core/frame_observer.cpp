#include "frame_observer.h"

#include <opencv2/imgproc.hpp>

#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr int kRigidIterations = 5;
constexpr int kPatchMargin = 32;            // [px] around features for their descriptors and patches
constexpr double kRigidConvergence = 3e-4;  // [m]
constexpr double kLearnTolerance = 0.008;   // [m], depth agrees well enough to learn the body's colours
constexpr double kLookAgain = 0.004;        // [m] of any vertex; a rough step beyond it is rendered again
constexpr double kLargestRigidStep = 0.1;   // [m] of any vertex; more is no tracking
constexpr double kEnoughAligned = 0.5;  // of the expected features; with fewer, descriptors are matched too
constexpr int kFramesBetweenAdmissions = 10;  // of new features
constexpr int kFewestExpectedFeatures = 30;   // with so many expected, hardly any found says something

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

}  // namespace

std::vector<Association> inliers(const std::vector<FeatureMatch>& matches) {
  std::vector<Association> result;
  result.reserve(2 * matches.size());
  for (const FeatureMatch& match : matches) {
    if (match.inlier) addAcrossRay(match.association, &result);
  }
  return result;
}

FrameObserver::FrameObserver(const TrackerConfig& config, const TetTopology& volume,
                             const MeshTopology& surface)
    : config_(config),
      volume_edge_m_(meanEdgeLength(volume.rest_vertices, volume.tets)),
      surface_(volume, surface),
      orb_(config.features.max_features),
      map_(config.features) {}

void FrameObserver::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  map_.rebind(surface_.volume(), volume);
  surface_ = PredictedSurface(volume, surface);
  volume_edge_m_ = meanEdgeLength(volume.rest_vertices, volume.tets);
}

void FrameObserver::reset() {
  map_.reset();
  colors_.reset();
  frames_to_admission_ = 0;
}

/// Share of the known features that show at a pose of the undeformed body; -1 where too few should.
double FrameObserver::featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose) {
  surface_.update(frame.camera, transformed(surface_.volume().rest_vertices, pose));
  const std::vector<FeatureMatch> matches = alignFeatures(frame);
  if (map_.expected() < kFewestExpectedFeatures) return -1.0;
  return static_cast<double>(matches.size()) / map_.expected();
}

void FrameObserver::learnColors(const RgbdFrame& frame) {
  const cv::Mat1f& rendered = surface_.image().depth;
  cv::Mat1b mask(rendered.size(), 0);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const bool agrees =
          rendered(v, u) > 0.0f && std::abs(rendered(v, u) - frame.depth(v, u)) < kLearnTolerance;
      mask(v, u) = agrees ? 255 : 0;
    }
  }
  cv::erode(mask, mask, cv::Mat());
  colors_.learn(frame.color, mask);
}

/// Renders and samples the prediction.
void FrameObserver::look(const RgbdFrame& frame, const Points& vertices) {
  surface_.update(frame.camera, vertices);
  samples_ = sampleSurface(surface_, config_.depth.max_targets);
}

/// The rigid motions that the depth and the features ask of the prediction. A piece that hardly shows stays.
RigidMotions FrameObserver::rigidMotions(const RgbdFrame& frame,
                                         const std::vector<FeatureMatch>& matches) const {
  RigidMotions motions(surface_.bodyCount(), Eigen::Isometry3d::Identity());
  const std::vector<Association> features = inliers(matches);
  for (int i = 0; i < kRigidIterations; ++i) {
    const DepthAssociations depth =
        associateDepth(frame, surface_.image(), samples_, motions, colors_, volume_edge_m_, config_.depth);
    std::vector<std::vector<Association>> of_body(motions.size());
    for (auto& associations : of_body) associations.reserve(depth.associations.size() + features.size());
    for (const Association& association : depth.associations)
      of_body[association.body].push_back(association);
    for (Association association : features) {
      association.predicted = motions[association.body] * association.predicted;
      of_body[association.body].push_back(association);
    }
    const RigidMotions before = motions;
    for (std::size_t body = 0; body < motions.size(); ++body) {
      if (static_cast<int>(of_body[body].size()) < kFewestAssociations) continue;
      motions[body] = rigidStep(of_body[body]) * motions[body];
    }
    const double moved =
        (surface_.movedVolume(motions) - surface_.movedVolume(before)).rowwise().norm().maxCoeff();
    if (moved > kLargestRigidStep) return before;
    if (moved < kRigidConvergence) break;
  }
  return motions;
}

/// How far the motions take any vertex of the prediction [m].
double FrameObserver::largestMotion(const RigidMotions& motions) const {
  return (surface_.movedVolume(motions) - surface_.volumeVertices()).rowwise().norm().maxCoeff();
}

cv::Rect FrameObserver::searchRegion(const cv::Size& size) const {
  const int margin = kWideSearchPx + kPatchMargin;
  const cv::Rect& covered = surface_.image().region;
  if (covered.empty()) return {};
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         cv::Rect(cv::Point(), size);
}

std::vector<FeatureMatch> FrameObserver::alignFeatures(const RgbdFrame& frame) {
  pyramid_.build(frame.color, searchRegion(frame.color.size()));
  return map_.align(frame, pyramid_, surface_);
}

bool FrameObserver::few(const std::vector<FeatureMatch>& matches) const {
  return static_cast<double>(matches.size()) < kEnoughAligned * map_.expected();
}

/// Features around the prediction; where most are not there, the descriptors say, in a wide window, where the
/// body went, and the depth if they do not.
void FrameObserver::followFeatures(const RgbdFrame& frame, Observation* seen) {
  seen->matches = alignFeatures(frame);
  if (few(seen->matches)) {
    seen->keypoints = extract(frame);
    map_.search(frame, pyramid_, seen->keypoints, surface_, &seen->matches);
    map_.judge(frame.camera, &seen->matches);
    const RigidMotions rough = rigidMotions(frame, seen->matches);
    if (largestMotion(rough) > kLookAgain) {
      look(frame, surface_.movedVolume(rough));
      seen->matches = alignFeatures(frame);
    }
  }
  map_.judge(frame.camera, &seen->matches);
}

std::vector<Keypoint> FrameObserver::extract(const RgbdFrame& frame) {
  frames_to_admission_ = kFramesBetweenAdmissions;
  const cv::Rect region = searchRegion(frame.color.size());
  return orb_.extract(frame.color, colors_.mask(frame.color, region), region);
}

Observation FrameObserver::observe(const RgbdFrame& frame, const Points& vertices) {
  Observation seen;
  look(frame, vertices);
  if (!colors_.learned()) learnColors(frame);
  followFeatures(frame, &seen);
  map_.credit(seen.matches);
  if (seen.keypoints.empty() && frames_to_admission_-- <= 0) seen.keypoints = extract(frame);
  const RigidMotions motions = rigidMotions(frame, seen.matches);
  seen.depth =
      associateDepth(frame, surface_.image(), samples_, motions, colors_, volume_edge_m_, config_.depth);
  surface_.move(motions);
  for (FeatureMatch& match : seen.matches) {
    match.association.predicted = motions[match.association.body] * match.association.predicted;
  }
  return seen;
}

void FrameObserver::admit(const RgbdFrame& frame, const Observation& seen) {
  if (seen.keypoints.empty()) return;
  surface_.update(frame.camera, surface_.volumeVertices());
  map_.admit(frame, pyramid_, seen.keypoints, seen.matches, surface_);
}

}  // namespace softbody
