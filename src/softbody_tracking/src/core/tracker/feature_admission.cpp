#include "tracker/feature_admission.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "features/feature_selection.h"
#include "prediction/place_deviation.h"

namespace softbody {
namespace {

// Tiles of the predicted surface: its quarters.
constexpr int kTiles = 4;
// Share of enough features that one tile may get; it may have more texture than others.
constexpr double kTileShare = 0.7;
// Smallest distance between features, in edges of the volume; closer ones measure the same vertices.
constexpr double kGap = 0.35;
// Features for each visible vertex of the volume; more add no information on its deformation, ...
constexpr int kEnoughOfVertex = 4;
// ... but recognition needs at least these, however coarse the volume is.
constexpr int kEnoughToRecognize = 300;

}  // namespace

void FeatureAdmission::reset() {
  rounds_.reset();
  fruitless_tiles_ = tile_ = 0;
}

int FeatureAdmission::enoughFeatures(double visible_vertices) const {
  const int of_volume = cvRound(kEnoughOfVertex * visible_vertices);
  return std::min(most_, std::max(kEnoughToRecognize, of_volume));
}

/// The next quarter of the rendered surface.
cv::Rect FeatureAdmission::nextTile(const cv::Rect& covered) {
  const cv::Point middle(covered.x + covered.width / 2, covered.y + covered.height / 2);
  const std::array<cv::Point, kTiles> corners = {
      covered.tl(), {covered.br().x, covered.y}, covered.br(), {covered.x, covered.br().y}};
  tile_ = (tile_ + 1) % kTiles;
  return cv::Rect(middle, corners[tile_]);
}

/// Admits features in the first view, or else in the next tile.
void FeatureAdmission::admitIn(const LearnedFrame& from, int room, FeatureMap* map) {
  const auto& [frame, seen, surface, labels, image, deviations, volume_edge_m] = from;
  KnownPlaces known;
  known.first_view = map->features().empty();
  for (const ExpectedFeature& expected : seen.expected.visible)
    known.places.push_back(map->features()[expected.feature].place);
  const int enough = cvCeil(kTileShare * enoughFeatures(seen.visible_vertices));
  const int wanted = known.first_view ? room : std::min(room, enough);
  const cv::Rect& covered = surface.image().region;
  const cv::Rect region = known.first_view ? covered : nextTile(covered);
  const cv::Mat1b free =
      withoutKnownFeatures(labels.maskOfBody(frame.color.size()), {seen.matches, seen.missed});
  const std::vector<cv::KeyPoint> corners =
      chooseCorners(frame, orb_.detect(frame.color, free, region), surface, seen.learnable, known, wanted,
                    kGap * volume_edge_m);
  std::vector<MapFeature> bound = bindKeypoints(frame, image, orb_.describe(frame.color, region, corners),
                                                surface, seen.learnable, map->room(seen.expected.count()));
  if (!deviations.empty())
    for (MapFeature& feature : bound)
      feature.place_variance = std::pow(deviationAt(feature.place, surface.volume(), deviations), 2);
  map->add(bound);
}

void FeatureAdmission::admit(const LearnedFrame& from, FeatureMap* map) {
  if (!rounds_.isDue(from.frame.stamp)) return;
  const std::size_t known = map->features().size();
  const int expected = from.seen.expected.count();
  const int room = std::min(map->room(expected), enoughFeatures(from.seen.visible_vertices) - expected);
  if (room <= 0) return;
  admitIn(from, room, map);
  const bool fruitful = map->features().size() > known;
  if (fruitful) rounds_.reset();
  fruitless_tiles_ = fruitful ? 0 : fruitless_tiles_ + 1;
  if (fruitless_tiles_ < kTiles) return;
  fruitless_tiles_ = 0;
  rounds_.failed();
}

}  // namespace softbody
