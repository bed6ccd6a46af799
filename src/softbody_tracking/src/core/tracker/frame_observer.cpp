#include "tracker/frame_observer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "alignment/rigid_alignment.h"
#include "features/feature_weights.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/time/time.h"

namespace softbody {

FrameObserver::FrameObserver(const TrackerConfig& config, const TetTopology& volume,
                             const MeshTopology& surface)
    : config_(config),
      model_(std::make_shared<SurfaceModel>(volume, surface)),
      view_settings_(config),
      weights_(config, volume),
      map_(config.max_features),
      admission_(config.max_features) {}

void FrameObserver::setConfig(const TrackerConfig& config) {
  config_ = config;
  view_settings_ = ViewSettings(config);
  weights_ = MeasurementWeights(config, model_->volume());
  map_.setMost(config.max_features);
  admission_.setMost(config.max_features);
}

void FrameObserver::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  map_.rebind(model_->volume(), volume);
  model_ = std::make_shared<SurfaceModel>(volume, surface);
  weights_ = MeasurementWeights(config_, volume);
  usual_error_ = {};
  guesses_.forgetPieces();
  admission_.bodyEdited();
  tracked_before_.clear();
}

void FrameObserver::foundAgain(bool searched) {
  searched_ = searched;
  last_labels_ = {};
  usual_error_ = {};
  tracked_before_.clear();
}

void FrameObserver::reset() {
  foundAgain(false);
  last_stamp_.reset();
  map_.reset();
  colors_.reset();
  depth_noise_ = {};
  guesses_.reset();
  admission_.reset();
}

ObservedBody FrameObserver::observe(const RgbdFrame& frame, const Points& predicted) {
  elapsed_s_ = last_stamp_ ? seconds(frame.stamp - *last_stamp_) : std::numeric_limits<double>::infinity();
  last_stamp_ = frame.stamp;
  View prediction = render(model_, frame.camera, predicted, view_settings_, &memory_);
  const GuessedBody body{model_,          view_settings_, weights_, usual_error_.meters(),
                         soughtIn(frame), last_labels_,   &memory_};
  // The first labels know no colours. A search compared the silhouette with the frame: beside it is no body.
  if (!colors_.learned())
    colors_.learn(frame, prediction.surface.image(),
                  searched_ ? silhouetteLabels(body, prediction) : labelsOf(body, prediction), elapsed_s_);
  Guess best = guesses_.best(body, std::move(prediction));
  const double visible_vertices =
      shownVertices(best.view.samples, model_->volume()) * best.features.expected.unoccludedShare();
  weighByAgreement(&best.features.found.matches);
  auto [guess, motions] = Guesses::aligned(body, std::move(best));
  const GrayPyramid image = guess.features.image;
  Observation seen = measure(frame, guess.view, guess.labels, motions, std::move(guess.features));
  seen.visible_vertices = visible_vertices;
  tracked_before_ = seen.atLeast(Visibility::kPartly);
  map_.score(seen.expected, seen.matches, tracked_before_, elapsed_s_);
  colors_.learn(frame, guess.view.surface.image(), guess.labels, elapsed_s_);
  last_labels_ = guess.labels.memory;
  PredictedSurface surface = moved(std::move(guess.view.surface), motions);
  usual_error_.learn(predicted, surface.volumeVertices(), elapsed_s_);
  movePredictions(motions, &seen.matches);
  return {std::move(seen), std::move(surface), image, std::move(guess.labels)};
}

/// Depth and contours of the view after the motions, beside its features.
Observation FrameObserver::measure(const RgbdFrame& frame, const View& view, const Labels& labels,
                                   const RigidMotions& motions, FoundFeatures features) {
  Observation seen;
  seen.matches = std::move(features.found.matches);
  seen.missed = std::move(features.found.missed);
  seen.expected = std::move(features.expected);
  seen.depth = depthOf(frame, view, motions, labels, weights_);
  depth_noise_.update(seen.depth.noise, elapsed_s_);
  const double edge_m = weights_.depth.edge_m;
  downweightByNoise(depth_noise_.patchStdDev(edge_m) / edge_m, &seen.depth);
  seen.outline = contoursOf(frame, view, motions, labels, weights_);
  weighByResidual(kRobustScale, &seen.outline.associations);
  return restrictedToVisible(std::move(seen), view.samples, view.surface.pieceVertices());
}

/// Pieces that were held in the last frame are not expected in their places. Without any other, all are.
SoughtFeatures FrameObserver::soughtIn(const RgbdFrame& frame) const {
  const bool any = std::find(tracked_before_.begin(), tracked_before_.end(), true) != tracked_before_.end();
  return {frame, map_.features(), colors_,
          any ? tracked_before_ : std::vector<bool>(model_->pieceCount(), true)};
}

void FrameObserver::learnFeatures(const RgbdFrame& frame, const ObservedBody& observed,
                                  const std::vector<float>& deviations) {
  admission_.admit({frame, observed.seen, observed.surface, observed.labels, observed.image, deviations,
                    weights_.depth.edge_m},
                   &map_);
  map_.retire();
}

std::optional<Eigen::Isometry3d> FrameObserver::recognizePose(const RgbdFrame& frame) const {
  if (map_.features().empty()) return std::nullopt;
  const Points& rest = model_->volume().rest_vertices;
  return recognizedMotion(finder_.recognize(soughtIn(frame), *model_, rest), recognitionTolerance(rest));
}

double FrameObserver::featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose) {
  const View view = render(model_, frame.camera, transformed(model_->volume().rest_vertices, pose),
                           view_settings_, &memory_);
  const SoughtFeatures sought = soughtIn(frame);
  const LabelMemory none;
  const Labels labels =
      labelsOf({model_, view_settings_, weights_, usual_error_.meters(), sought, none, &memory_}, view);
  const FoundFeatures features = finder_.findAll(sought, finder_.expect(sought, view.surface, labels));
  const int expected = features.expected.count();
  if (expected < kFewestExpectedFeatures) return -1.0;
  return static_cast<double>(features.found.matches.size()) / expected;
}

}  // namespace softbody
