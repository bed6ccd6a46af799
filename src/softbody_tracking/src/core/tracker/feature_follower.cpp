#include "tracker/feature_follower.h"

#include <algorithm>
#include <utility>

#include "features/feature_outliers.h"

namespace softbody {
namespace {

// Pixels around the searched region that descriptors and patches need.
constexpr int kPatchMargin = 32;
// Motion of a vertex [m] from which the prediction is rendered again; less does not change what is visible.
constexpr double kRenderAgain = 0.004;
// Share of the expected features that must be matched; with fewer the descriptors are matched too.
constexpr double kEnoughAligned = 0.5;
// Features that are aligned first, to see whether the prediction is far off.
constexpr int kScouts = 48;
// Distance from the expected pixel [px] that full resolution can hardly align.
constexpr double kFarOff = 4.0;

bool any(const std::vector<bool>& pieces) {
  return std::find(pieces.begin(), pieces.end(), true) != pieces.end();
}

/// The rendered body with a margin for features at this distance from their expected pixels.
cv::Rect searchRegion(const PredictedSurface& surface, const cv::Size& size, int reach_px) {
  const int margin = reach_px + kPatchMargin;
  const cv::Rect& covered = surface.image().region;
  if (covered.empty()) return {};
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         cv::Rect(cv::Point(), size);
}

/// Whether most scouts are far from their expected pixels.
bool isFarOff(const std::vector<bool>& followed, const Pinhole& camera,
              const std::vector<FeatureMatch>& scouts) {
  const int count = matchesOn(followed, scouts);
  const auto far = std::count_if(scouts.begin(), scouts.end(), [&](const FeatureMatch& match) {
    const Eigen::Vector2d predicted = camera.project(match.association.predicted);
    return followed[match.association.piece] &&
           (predicted - Eigen::Vector2d(match.pixel.x, match.pixel.y)).norm() > kFarOff;
  });
  return count >= kFewestAssociations && 2 * far > count;
}

/// The volume's vertices, with some pieces moved. @param moved of each piece, whether it takes its new
/// vertices.
Points withMovedPieces(Points vertices, const std::vector<std::vector<int>>& pieces,
                       const std::vector<Points>& new_vertices, const std::vector<bool>& moved) {
  for (std::size_t piece = 0; piece < moved.size(); ++piece)
    if (moved[piece]) vertices(pieces[piece], Eigen::all) = new_vertices[piece];
  return vertices;
}

/// The moved pieces that show enough features in their new places, and more than before.
std::vector<bool> confirmedMoves(const std::vector<bool>& moved, const std::vector<FeatureCount>& before,
                                 const std::vector<FeatureCount>& after) {
  std::vector<bool> confirmed(moved.size());
  for (std::size_t piece = 0; piece < moved.size(); ++piece)
    confirmed[piece] = moved[piece] && after[piece].found > before[piece].found && !after[piece].isMissing();
  return confirmed;
}

}  // namespace

void FeatureFollower::reset() {
  wide_search_.reset();
  piece_search_.reset();
  frame_matcher_.reset();
}

FollowedFeatures FeatureFollower::follow(const FollowedBody& body, RenderedPrediction* prediction) {
  if (features_.between_frames) return matchLastFrame(body, prediction->surface());
  FollowedFeatures features = matchAround(body, prediction);
  if (matchesOn(body.followed, features.found.matches) <
      kEnoughAligned * features.expected.countOn(body.followed))
    features = improvePrediction(body, std::move(features), prediction);
  if (!countOn(body.followed, features.expected, features.found.matches).isMissing()) wide_search_.reset();
  const std::vector<bool> due = piece_search_.duePieces(
      countByPiece(body.followed.size(), features.expected, features.found.matches), body.followed);
  if (any(due)) features = searchPieces(body, due, std::move(features), prediction);
  return features;
}

FollowedFeatures FeatureFollower::alignAt(const Points& vertices, const FollowedBody& body,
                                          RenderedPrediction* prediction) {
  prediction->render(body.frame.camera, vertices);
  FollowedFeatures features;
  features.expected = expect(body, prediction->surface());
  features.found = FeatureMatcher(features_, body.known, body.frame, image_).alignAll(features.expected);
  return features;
}

std::vector<PointPair> FeatureFollower::recognize(const FollowedBody& body, const SurfaceModel& model,
                                                  const Points& vertices) {
  return recognizedFeatures(body.frame, body.known, keypointsOfImage(body), model, vertices,
                            features_.max_hamming_distance);
}

std::vector<Keypoint> FeatureFollower::keypointsOfImage(const FollowedBody& body) {
  const cv::Mat3b& color = body.frame.color;
  const cv::Rect image(cv::Point(), color.size());
  return orb_.extract(color, body.colors.mask(color, image), image);
}

/// The prediction says only which features can be seen.
FollowedFeatures FeatureFollower::matchLastFrame(const FollowedBody& body, const PredictedSurface& surface) {
  FollowedFeatures features;
  features.expected = expect(body, surface);
  features.found = frame_matcher_.match(body.known, features.expected, keypointsOfImage(body), body.frame);
  return features;
}

void FeatureFollower::buildImage(const RgbdFrame& frame, const PredictedSurface& surface, int reach_px) {
  image_.build(frame.color, searchRegion(surface, frame.color.size(), reach_px));
}

ExpectedFeatures FeatureFollower::expect(const FollowedBody& body, const PredictedSurface& surface) {
  buildImage(body.frame, surface, features_.search_radius_px);
  return expectFeatures(body.known, body.frame, body.colors, reach_m_, surface);
}

/// Aligns patches around their expected pixels. If scouts show that the prediction is far off, the other
/// patches are looked for where the scouts' rigid motion takes them.
FollowedFeatures FeatureFollower::matchAround(const FollowedBody& body, RenderedPrediction* prediction) {
  const Pinhole& camera = body.frame.camera;
  const FeatureMatcher matcher(features_, body.known, body.frame, image_);
  FollowedFeatures features;
  features.expected = expect(body, prediction->surface());
  FeatureMatches scouts = matcher.alignSome(features.expected, kScouts);
  if (isFarOff(body.followed, camera, scouts.matches)) {
    features.expected = lookedForAfter(prediction->align(body.frame, body.colors, scouts.matches), camera,
                                       std::move(features.expected));
    features.found = matcher.alignAll(features.expected);
  } else {
    features.found = matcher.alignOthers(features.expected, kScouts, std::move(scouts));
  }
  markOutliers(camera, features_.max_disagreement_m, &features.found.matches);
  return features;
}

/// Adds matches of descriptors in a wide window.
FollowedFeatures FeatureFollower::searchWide(const FollowedBody& body, const PredictedSurface& surface,
                                             FollowedFeatures features) {
  const cv::Mat3b& color = body.frame.color;
  buildImage(body.frame, surface, std::max(kWideSearchPx, features_.search_radius_px));
  const cv::Rect region = searchRegion(surface, color.size(), kWideSearchPx);
  const std::vector<Keypoint> keypoints = orb_.extract(color, body.colors.mask(color, region), region);
  const std::vector<FeatureMatch> more = FeatureMatcher(features_, body.known, body.frame, image_)
                                             .matchDescriptors(features.found.missed, keypoints);
  features.found.matches.insert(features.found.matches.end(), more.begin(), more.end());
  markOutliers(body.frame.camera, features_.max_disagreement_m, &features.found.matches);
  return features;
}

/// Renders the prediction where features, or the depth without them, say that the body is, and matches again.
FollowedFeatures FeatureFollower::improvePrediction(const FollowedBody& body, FollowedFeatures features,
                                                    RenderedPrediction* prediction) {
  if (wide_search_.isDue()) features = searchWide(body, prediction->surface(), std::move(features));
  const RigidMotions rough = prediction->align(body.frame, body.colors, features.found.matches);
  if (largestMotion(prediction->surface(), rough) <= kRenderAgain) return features;
  prediction->render(body.frame.camera, prediction->surface().movedVolume(rough));
  return matchAround(body, prediction);
}

/// Moves missing pieces to where they are recognised, if enough of their features are then found there.
FollowedFeatures FeatureFollower::searchPieces(const FollowedBody& body, const std::vector<bool>& due,
                                               FollowedFeatures features, RenderedPrediction* prediction) {
  const PredictedSurface& surface = prediction->surface();
  const Points before = surface.volumeVertices();
  const std::vector<Points> recognized =
      recognizedPieces(recognize(body, surface.model(), before), surface, due, kRenderAgain);
  std::vector<bool> moved;
  moved.reserve(recognized.size());
  for (const Points& piece : recognized) moved.push_back(piece.rows() > 0);
  if (!any(moved)) return features;
  const std::vector<FeatureCount> counts_before =
      countByPiece(moved.size(), features.expected, features.found.matches);
  while (any(moved)) {
    prediction->render(body.frame.camera,
                       withMovedPieces(before, prediction->surface().model().pieces(), recognized, moved));
    FollowedFeatures there = matchAround(body, prediction);
    const std::vector<bool> confirmed =
        confirmedMoves(moved, counts_before, countByPiece(moved.size(), there.expected, there.found.matches));
    if (confirmed == moved) {
      piece_search_.markFound(moved);
      return there;
    }
    moved = confirmed;
  }
  prediction->render(body.frame.camera, before);
  buildImage(body.frame, surface, features_.search_radius_px);
  return features;
}

}  // namespace softbody
