#include "tracker/frame_observer.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr int kPatchMargin = 32;           // [px] around features for their descriptors and patches
constexpr double kLearnTolerance = 0.008;  // [m], depth agrees well enough to learn the body's colours
constexpr double kLookAgain = 0.004;       // [m] of any vertex; a rough step beyond it is rendered again
constexpr double kEnoughAligned = 0.5;  // of the expected features; with fewer, descriptors are matched too
constexpr double kHardlyAny = 0.2;      // of the expected features: the piece is not there
constexpr int kFramesBetweenSearches = 10;  // for a piece that is held
constexpr int kTiles = 4;                   // of the predicted surface
constexpr double kTileShare = 0.7;          // of enough features: a tile may have more texture than others
constexpr int kFramesBetweenTiles = 3;  // in which new features are looked for, and so many times that ...
constexpr int kSlowTiles = 3;           // ... where all of them were looked through in vain
constexpr double kGap = 0.35;           // of the volume's edges, between features
constexpr int kEnoughOfVertex =
    4;  // features for each vertex that shows uncovered: more say nothing new, ...
constexpr int kEnoughToRecognize = 300;  // ... but these, however coarse the volume is
constexpr int kScouts = 48;              // features that say whether the prediction is far off
constexpr double kFarOff = 4.0;          // [px] that full resolution hardly aligns

bool any(const std::vector<bool>& pieces) {
  return std::find(pieces.begin(), pieces.end(), true) != pieces.end();
}

/// Outlines that nothing would use are not looked for.
OutlineConfig usedOutline(const TrackerConfig& config) {
  OutlineConfig outline = config.outline;
  if (config.knn_targets || !config.use_depth) outline.weight = 0.0;
  return outline;
}

}  // namespace

FrameObserver::FrameObserver(const TrackerConfig& config, const TetTopology& volume,
                             const MeshTopology& surface)
    : config_(config),
      volume_edge_m_(meanEdgeLength(volume.rest_vertices, volume.tets)),
      surface_(volume, surface),
      depth_(config.depth, volume_edge_m_),
      outline_(usedOutline(config), volume_edge_m_),
      map_(config.features) {}

void FrameObserver::setTopologies(const TetTopology& volume, const MeshTopology& surface) {
  map_.rebind(surface_.volume(), volume);
  surface_ = PredictedSurface(volume, surface);
  volume_edge_m_ = meanEdgeLength(volume.rest_vertices, volume.tets);
  depth_ = DepthAssociator(config_.depth, volume_edge_m_);
  outline_ = OutlineAssociator(usedOutline(config_), volume_edge_m_);
  shown_before_.clear();
  searches_.clear();
  tiles_in_vain_ = 0;
}

void FrameObserver::reset() {
  map_.reset();
  colors_.reset();
  depth_noise_ = {};
  shown_before_.clear();
  searches_.clear();
  wide_search_.reset();
  frames_to_admission_ = frames_to_search_ = tiles_in_vain_ = tile_ = 0;
}

/// Features recognised anywhere in the frame. @param vertices of the volume as they are expected.
std::vector<PointPair> FrameObserver::recognizeFeatures(const RgbdFrame& frame, const Points& vertices) {
  const cv::Rect image(cv::Point(), frame.color.size());
  return recognizedFeatures(frame, map_.features(),
                            orb_.extract(frame.color, colors_.mask(frame.color, image), image), surface_,
                            vertices, config_.features.max_hamming_distance);
}

std::optional<Eigen::Isometry3d> FrameObserver::recognize(const RgbdFrame& frame) {
  if (map_.features().empty()) return std::nullopt;
  const Points& rest = surface_.volume().rest_vertices;
  return recognizedMotion(recognizeFeatures(frame, rest), recognitionTolerance(rest));
}

/// Share of the known features that show at a pose of the undeformed body; -1 where too few should.
double FrameObserver::featureShare(const RgbdFrame& frame, const Eigen::Isometry3d& pose) {
  surface_.update(frame.camera, transformed(surface_.volume().rest_vertices, pose));
  expectFeatures(frame);
  std::vector<FeatureMatch> matches;
  map_.align(frame, pyramid_, FeatureMap::kAll, &matches);
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
  samples_ = sampleSurface(surface_, config_.depth.max_targets, std::move(samples_));
  outline_.sample(surface_);
}

RigidMotions FrameObserver::alignRigidly(const RgbdFrame& frame, const std::vector<FeatureMatch>& matches) {
  return rigid_.align(frame, surface_, samples_, colors_, matches, &depth_);
}

/// Where features may be, so far from their predictions, and what surrounds them.
cv::Rect FrameObserver::searchRegion(const cv::Size& size, int reach_px) const {
  const int margin = reach_px + kPatchMargin;
  const cv::Rect& covered = surface_.image().region;
  if (covered.empty()) return {};
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         cv::Rect(cv::Point(), size);
}

/// A quarter of the predicted surface after the other.
cv::Rect FrameObserver::nextTile() {
  const cv::Rect& covered = surface_.image().region;
  const cv::Point middle(covered.x + covered.width / 2, covered.y + covered.height / 2);
  const std::array<cv::Point, kTiles> corners = {
      covered.tl(), {covered.br().x, covered.y}, covered.br(), {covered.x, covered.br().y}};
  tile_ = (tile_ + 1) % kTiles;
  return cv::Rect(middle, corners[tile_]);
}

void FrameObserver::buildPyramid(const RgbdFrame& frame, int reach_px) {
  pyramid_.build(frame.color, searchRegion(frame.color.size(), reach_px));
}

void FrameObserver::expectFeatures(const RgbdFrame& frame) {
  buildPyramid(frame, config_.features.search_radius_px);
  map_.predict(frame, colors_, config_.depth.max_distance_m, surface_);
}

/// Some features first, from coarse to fine: where they say that the prediction is far off, all are looked
/// for where it moves rigidly to. Outliers are marked.
std::vector<FeatureMatch> FrameObserver::alignFeatures(const RgbdFrame& frame) {
  expectFeatures(frame);
  std::vector<FeatureMatch> matches;
  map_.align(frame, pyramid_, kScouts, &matches);
  if (farOff(matches)) {
    map_.shift(frame.camera, alignRigidly(frame, matches));
    matches.clear();
  }
  map_.align(frame, pyramid_, FeatureMap::kAll, &matches);
  markOutliers(frame.camera, config_.features.max_disagreement_m, &matches);
  return matches;
}

/// Those whose features say whether the prediction is right: what is held where it was is not expected to be
/// there. With nothing else, that says it too.
std::vector<bool> FrameObserver::followedPieces() const {
  return any(shown_before_) ? shown_before_ : std::vector<bool>(surface_.pieceCount(), true);
}

bool FrameObserver::farOff(const std::vector<FeatureMatch>& scouts) const {
  const std::vector<bool> followed = followedPieces();
  const int count = matchesOn(followed, scouts);
  const auto far = std::count_if(scouts.begin(), scouts.end(), [&](const FeatureMatch& match) {
    const Eigen::Vector2d predicted = surface_.camera().project(match.association.predicted);
    return followed[match.association.body] &&
           (predicted - Eigen::Vector2d(match.pixel.x, match.pixel.y)).norm() > kFarOff;
  });
  return count >= kFewestAssociations && 2 * far > count;
}

bool FrameObserver::few(const std::vector<FeatureMatch>& matches) const {
  const std::vector<bool> followed = followedPieces();
  return matchesOn(followed, matches) < kEnoughAligned * map_.expected(followed);
}

bool FrameObserver::FeatureCount::hardlyAny() const { return found < kHardlyAny * expected; }

bool FrameObserver::hardlyAny(const std::vector<FeatureMatch>& matches) const {
  const std::vector<bool> followed = followedPieces();
  FeatureCount sum{map_.expected(followed), 0};
  for (const FeatureMatch& match : matches)
    sum.found += match.inlier && followed[match.association.body] ? 1 : 0;
  return sum.hardlyAny();
}

/// Features around the prediction; where most are not there, the descriptors say, in a wide window, where the
/// body went, and the depth if they do not.
void FrameObserver::followFeatures(const RgbdFrame& frame, Observation* seen) {
  seen->matches = alignFeatures(frame);
  if (few(seen->matches)) {
    if (wide_search_.isDue()) {
      buildPyramid(frame, std::max(kWideSearchPx, config_.features.search_radius_px));
      map_.search(frame, pyramid_, extract(frame), surface_, &seen->matches);
      markOutliers(frame.camera, config_.features.max_disagreement_m, &seen->matches);
    }
    const RigidMotions rough = alignRigidly(frame, seen->matches);
    if (largestMotion(surface_, rough) > kLookAgain) {
      look(frame, surface_.movedVolume(rough));
      seen->matches = alignFeatures(frame);
    }
  }
  if (!hardlyAny(seen->matches)) wide_search_.reset();
  const std::vector<bool> gone = gonePieces(seen->matches);
  if (any(gone)) lookWhereRecognized(frame, gone, seen);
  weighByAgreement(&seen->matches);
  weighByDensity(vertices(), &seen->matches);
}

FrameObserver::FeatureCount FrameObserver::countOn(std::size_t piece,
                                                   const std::vector<FeatureMatch>& matches) const {
  std::vector<bool> counted(surface_.pieceCount());
  counted[piece] = true;
  const auto inliers = std::count_if(matches.begin(), matches.end(), [&](const FeatureMatch& match) {
    return match.inlier && match.association.body == piece;
  });
  return {map_.expected(counted), static_cast<int>(inliers)};
}

/// Pieces to be searched for: hardly any feature is where it was predicted. What is held where it was is
/// seldom asked for: it may be covered for long.
std::vector<bool> FrameObserver::gonePieces(const std::vector<FeatureMatch>& matches) {
  frames_to_search_ = frames_to_search_ > 0 ? frames_to_search_ - 1 : kFramesBetweenSearches - 1;
  const std::vector<bool> followed = followedPieces();
  std::vector<bool> gone(surface_.pieceCount());
  searches_.resize(gone.size());
  for (std::size_t piece = 0; piece < gone.size(); ++piece) {
    const FeatureCount count = countOn(piece, matches);
    if (count.expected < kFewestExpectedFeatures) continue;
    if (!count.hardlyAny())
      searches_[piece].reset();
    else
      gone[piece] = followed[piece] ? searches_[piece].isDue() : frames_to_search_ == 0;
  }
  return gone;
}

/// Pieces go where they are recognised, each if enough of its features are then found there, and more than
/// were.
void FrameObserver::lookWhereRecognized(const RgbdFrame& frame, const std::vector<bool>& gone,
                                        Observation* seen) {
  const Points before = surface_.volumeVertices();
  const std::vector<Points> there =
      recognizedPieces(recognizeFeatures(frame, before), surface_, gone, kLookAgain);
  std::vector<bool> moved;
  std::vector<int> found_before;
  for (std::size_t piece = 0; piece < there.size(); ++piece) {
    moved.push_back(there[piece].rows() > 0);
    found_before.push_back(countOn(piece, seen->matches).found);
  }
  if (!any(moved)) return;
  while (any(moved)) {
    Points vertices = before;
    for (std::size_t piece = 0; piece < moved.size(); ++piece)
      if (moved[piece]) vertices(surface_.pieces()[piece], Eigen::all) = there[piece];
    look(frame, vertices);
    std::vector<FeatureMatch> matches = alignFeatures(frame);
    std::vector<bool> confirmed = moved;
    for (std::size_t piece = 0; piece < moved.size(); ++piece) {
      const FeatureCount count = countOn(piece, matches);
      confirmed[piece] = moved[piece] && count.found > found_before[piece] && !count.hardlyAny();
    }
    if (confirmed == moved) {
      for (std::size_t piece = 0; piece < moved.size(); ++piece)
        if (moved[piece]) searches_[piece].reset();
      seen->matches = std::move(matches);
      return;
    }
    moved = std::move(confirmed);
  }
  look(frame, before);
  alignFeatures(frame);  // what is missed is known by it
}

/// Wherever the body may be.
std::vector<Keypoint> FrameObserver::extract(const RgbdFrame& frame) {
  const cv::Rect region = searchRegion(frame.color.size(), kWideSearchPx);
  return orb_.extract(frame.color, colors_.mask(frame.color, region), region);
}

std::vector<bool> Observation::atLeast(Shows least) const {
  std::vector<bool> result;
  for (const Shows piece : shown) result.push_back(piece >= least);
  return result;
}

/// What hardly shows is held where it was, and what shows loosely goes where the rigid step took it: depth at
/// its rims would bend it.
void FrameObserver::keepShownPieces(Observation* seen) const {
  const std::vector<Association>& depth = seen->depth.associations;
  seen->agreeing_blocks = depth.size();
  seen->shown = shownPieces(samples_, depth, seen->matches, surface_.pieceVertices());
  seen->learnable = confirmedPieces(samples_, depth, seen->shown.size());
  seen->in_view = predictedPieces(samples_, seen->shown.size());
  const std::vector<bool> well = seen->atLeast(Shows::kWell), loosely = seen->atLeast(Shows::kLoosely);
  seen->expected_features = map_.expected(loosely);
  seen->matched_features = matchesOn(loosely, seen->matches);
  for (std::size_t p = 0; p < well.size(); ++p) seen->learnable[p] = seen->learnable[p] || well[p];
  const auto is_loose = [&](const Association& association) { return !well[association.body]; };
  for (std::vector<Association>* found : {&seen->depth.associations, &seen->outline})
    found->erase(std::remove_if(found->begin(), found->end(), is_loose), found->end());
  for (FeatureMatch& match : seen->matches) match.inlier = match.inlier && loosely[match.association.body];
}

Observation FrameObserver::observe(const RgbdFrame& frame, const Points& vertices) {
  Observation seen;
  look(frame, vertices);
  if (!colors_.learned()) learnColors(frame);
  followFeatures(frame, &seen);
  const RigidMotions motions = alignRigidly(frame, seen.matches);
  seen.depth = depth_.associate(frame, surface_.image(), samples_, motions, colors_);
  depth_noise_.update(seen.depth.noise);
  downweightByNoise(depth_noise_.patchStdDev(volume_edge_m_) / volume_edge_m_, &seen.depth);
  seen.outline = outline_.associate(frame, surface_.image(), motions, colors_);
  keepShownPieces(&seen);
  shown_before_ = seen.atLeast(Shows::kLoosely);
  map_.credit(seen.matches, shown_before_);
  surface_.move(motions);
  for (FeatureMatch& match : seen.matches) {
    match.association.predicted = motions[match.association.body] * match.association.predicted;
  }
  return seen;
}

/// Of the volume, as many as show and are not covered. Features say what is.
double FrameObserver::vertices() const {
  return shownVertices(samples_, surface_.volume()) * map_.uncoveredShare();
}

int FrameObserver::enoughFeatures() const {
  const int of_volume = cvRound(kEnoughOfVertex * vertices());
  return std::min(config_.features.max_features, std::max(kEnoughToRecognize, of_volume));
}

/// The first features at once; later only in gaps between the known ones, tile by tile, so that no frame
/// takes much longer than others.
void FrameObserver::admitNew(const RgbdFrame& frame, const Observation& seen, int room) {
  const bool first = map_.features().empty();
  const int wanted = first ? room : std::min(room, cvCeil(kTileShare * enoughFeatures()));
  const cv::Rect region = first ? surface_.image().region : nextTile();
  cv::Mat1b free = colors_.mask(frame.color, region);
  map_.eraseTaken(seen.matches, &free);
  const std::vector<cv::KeyPoint> corners = map_.choose(
      frame, orb_.detect(frame.color, free, region), surface_, seen.learnable, wanted, kGap * volume_edge_m_);
  map_.admit(frame, pyramid_, orb_.describe(frame.color, region, corners), surface_, seen.learnable);
}

void FrameObserver::admit(const RgbdFrame& frame, const Observation& seen) {
  if (--frames_to_admission_ < 0) {
    const std::size_t known = map_.features().size();
    const int room = std::min(map_.room(), enoughFeatures() - map_.expected());
    const bool full = room <= 0;
    if (!full) admitNew(frame, seen, room);
    tiles_in_vain_ = full || map_.features().size() > known ? 0 : tiles_in_vain_ + 1;
    frames_to_admission_ = kFramesBetweenTiles * (tiles_in_vain_ < kTiles ? 1 : kSlowTiles) - 1;
  }
  map_.retire();
}

}  // namespace softbody
