#include "tracker/guesses.h"

#include <algorithm>
#include <utility>

#include "alignment/rigid_alignment.h"

namespace softbody {
namespace {

// Motion of a vertex [m] from which a guess is another guess; less does not change what is visible.
constexpr double kOtherGuess = 0.004;
// Share of the expected features that must be found; with fewer the guess is aligned.
constexpr double kEnoughFound = 0.5;

bool any(const std::vector<bool>& pieces) {
  return std::find(pieces.begin(), pieces.end(), true) != pieces.end();
}

RigidMotions alignedMotions(const GuessedBody& body, const View& view, const Labels& labels,
                            const std::vector<FeatureMatch>& matches) {
  return alignRigidly(body.sought.frame, view, labels, matches, body.weights);
}

std::vector<FeatureCount> countsOf(const GuessedBody& body, const FoundFeatures& features) {
  return countByPiece(body.model->pieceCount(), features.expected, features.found.matches);
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

Labels labelsOf(const GuessedBody& body, const View& view) {
  return labelsOf(body.sought.frame, view.surface, view.samples, body.sought.colors, body.last_labels,
                  body.usual_error_m);
}

Labels silhouetteLabels(const GuessedBody& body, const View& view) {
  Labels labels = labelsOf(body, view);
  if (labels.region.empty()) return labels;
  const cv::Mat1f rendered = view.surface.image().depth(labels.region);
  labels.label.setTo(labels::kBackground, (rendered <= 0.0f) & (labels.label == labels::kBody));
  return labels;
}

void Guesses::reset() {
  wide_search_.reset();
  piece_search_.reset();
}

Guess Guesses::best(const GuessedBody& body, View prediction) {
  const std::vector<bool>& followed = body.sought.followed;
  Guess best = guessAt(body, std::move(prediction));
  if (matchesOn(followed, best.features.found.matches) <
      kEnoughFound * best.features.expected.countOn(followed))
    best = movedGuess(body, std::move(best));
  if (!countOn(followed, best.features.expected, best.features.found.matches).isMissing())
    wide_search_.reset();
  const std::vector<bool> due =
      piece_search_.duePieces(countsOf(body, best.features), body.sought.frame.stamp);
  return any(due) ? withPiecesFound(body, due, std::move(best)) : best;
}

AlignedGuess Guesses::aligned(const GuessedBody& body, Guess guess) {
  std::vector<FeatureMatch>& matches = guess.features.found.matches;
  RigidMotions motions = alignedMotions(body, guess.view, guess.labels, matches);
  if (largestMotion(guess.view.surface, motions) > kOtherGuess) {
    movePredictions(motions, &matches);
    guess.view = render(body.model, body.sought.frame.camera, guess.view.surface.movedVolume(motions),
                        body.settings, body.memory);
    guess.labels = labelsOf(body, guess.view);
    motions = alignedMotions(body, guess.view, guess.labels, matches);
  }
  return {std::move(guess), std::move(motions)};
}

/// Looks for the features around their expected pixels. If scouts show that the view is far off, the others
/// are looked for where the scouts' rigid motion takes them.
Guess Guesses::guessAt(const GuessedBody& body, View view) const {
  Labels labels = labelsOf(body, view);
  FoundFeatures features = finder_.findScouts(body.sought, finder_.expect(body.sought, view.surface, labels));
  if (FeatureFinder::areFarOff(body.sought, features)) {
    const RigidMotions motions = alignedMotions(body, view, labels, features.found.matches);
    features = finder_.findAfter(body.sought, motions, std::move(features));
  } else {
    features = finder_.findOthers(body.sought, std::move(features));
  }
  return {std::move(view), std::move(labels), std::move(features)};
}

Guess Guesses::guessAt(const GuessedBody& body, const Points& vertices) const {
  return guessAt(body, render(body.model, body.sought.frame.camera, vertices, body.settings, body.memory));
}

/// The guess where the features, or the depth without them, say that the body is.
Guess Guesses::movedGuess(const GuessedBody& body, Guess guess) {
  const PredictedSurface& surface = guess.view.surface;
  if (wide_search_.isDue(body.sought.frame.stamp)) {
    guess.features = finder_.addFromAfar(body.sought, surface, std::move(guess.features));
    wide_search_.failed();
  }
  const RigidMotions motions = alignedMotions(body, guess.view, guess.labels, guess.features.found.matches);
  if (largestMotion(surface, motions) <= kOtherGuess) return guess;
  return guessAt(body, surface.movedVolume(motions));
}

/// The guess with missing pieces where they are recognised, if enough of their features are found there.
/// @param due the pieces to look for.
Guess Guesses::withPiecesFound(const GuessedBody& body, const std::vector<bool>& due, Guess guess) {
  const PredictedSurface& surface = guess.view.surface;
  const Points& before = surface.volumeVertices();
  const std::vector<Points> recognized =
      recognizedPieces(finder_.recognize(body.sought, *body.model, before), surface, due, kOtherGuess);
  std::vector<bool> moved;
  moved.reserve(recognized.size());
  for (const Points& piece : recognized) moved.push_back(piece.rows() > 0);
  const std::vector<FeatureCount> counts_before = countsOf(body, guess.features);
  while (any(moved)) {
    Guess there = guessAt(body, withMovedPieces(before, body.model->pieces(), recognized, moved));
    const std::vector<bool> confirmed = confirmedMoves(moved, counts_before, countsOf(body, there.features));
    if (confirmed == moved) {
      piece_search_.markFound(moved);
      return there;
    }
    moved = confirmed;
  }
  return guess;
}

}  // namespace softbody
