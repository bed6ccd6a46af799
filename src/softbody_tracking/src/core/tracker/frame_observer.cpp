#include "tracker/frame_observer.h"

#include <algorithm>
#include <utility>

#include "features/feature_weights.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
FrameObserver::FrameObserver(const TrackerConfig& config, const TetTopology& volume,
                             const MeshTopology& surface)
    : config_(config),
      prediction_(config, volume, surface),
      map_(config.features),
      follower_(config),
      admission_(config.features) {}

void FrameObserver::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  map_.rebind(prediction_.model().volume(), volume);
  prediction_ = RenderedPrediction(config_, volume, surface);
  follower_.forgetPieces();
  admission_.bodyEdited();
  tracked_before_.clear();
}

void FrameObserver::reset() {
  map_.reset();
  colors_.reset();
  depth_noise_ = {};
  follower_.reset();
  admission_.reset();
  tracked_before_.clear();
  prediction_.forgetError();
}

Observation FrameObserver::observe(const RgbdFrame& frame, const Points& predicted) {
  prediction_.render(frame.camera, predicted);
  if (!colors_.learned())
    colors_.learn(frame.color, agreeingPixels(prediction_.surface().image().depth, frame.depth));
  if (!colors_.region().learned()) colors_.learnRegion(frame, prediction_.surface().image());
  FollowedFeatures features = follower_.follow(followedBody(frame), &prediction_);
  const double visible_vertices = shownVertices(prediction_.samples(), prediction_.surface().volume()) *
                                  features.expected.unoccludedShare();
  weighByAgreement(&features.found.matches);
  weighByDensity(visible_vertices, &features.found.matches);
  const RigidMotions motions = prediction_.align(frame, colors_, features.found.matches);
  Observation seen = measure(frame, motions, std::move(features));
  seen.visible_vertices = visible_vertices;
  tracked_before_ = seen.atLeast(Observability::kPartial);
  map_.score(seen.expected, seen.matches, tracked_before_);
  colors_.learnRegion(frame, prediction_.surface().image());
  prediction_.move(motions);
  prediction_.learnError(predicted);
  for (FeatureMatch& match : seen.matches)
    match.association.predicted = motions[match.association.piece] * match.association.predicted;
  return seen;
}

/// Depth and outline of the prediction after the motions, beside its features.
Observation FrameObserver::measure(const RgbdFrame& frame, const RigidMotions& motions,
                                   FollowedFeatures features) {
  Observation seen;
  seen.matches = std::move(features.found.matches);
  seen.missed = std::move(features.found.missed);
  seen.expected = std::move(features.expected);
  seen.depth = prediction_.depthOf(frame, motions, colors_);
  depth_noise_.update(seen.depth.noise);
  const double edge_m = prediction_.volumeEdge();
  downweightByNoise(depth_noise_.patchStdDev(edge_m) / edge_m, &seen.depth);
  seen.outline = prediction_.contoursOf(frame, motions, colors_);
  weighByResidual(kContourScale, &seen.outline.associations);
  return restrictedToObservable(std::move(seen), prediction_.samples(),
                                prediction_.surface().pieceVertices());
}

/// Pieces that were held in the last frame are not expected in their places. Without any other, all are.
FollowedBody FrameObserver::followedBody(const RgbdFrame& frame) const {
  const bool any = std::find(tracked_before_.begin(), tracked_before_.end(), true) != tracked_before_.end();
  return {frame, map_.features(), colors_,
          any ? tracked_before_ : std::vector<bool>(model().pieceCount(), true)};
}

void FrameObserver::learnFeatures(const RgbdFrame& frame, const Observation& seen,
                                  const std::vector<float>& deviations) {
  admission_.admit(
      {frame, seen, prediction_.surface(), colors_, follower_.image(), deviations, prediction_.volumeEdge()},
      &map_);
  map_.retire();
}

std::optional<Eigen::Isometry3d> FrameObserver::recognizePose(const RgbdFrame& frame) {
  if (map_.features().empty()) return std::nullopt;
  const Points& rest = model().volume().rest_vertices;
  return recognizedMotion(follower_.recognize(followedBody(frame), model(), rest),
                          recognitionTolerance(rest));
}

double FrameObserver::featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose) {
  const Points vertices = transformed(model().volume().rest_vertices, pose);
  const FollowedFeatures features = follower_.alignAt(vertices, followedBody(frame), &prediction_);
  const int expected = features.expected.count();
  if (expected < kFewestExpectedFeatures) return -1.0;
  return static_cast<double>(features.found.matches.size()) / expected;
}

}  // namespace softbody
