#pragma once

#include <memory>
#include <vector>

#include "labels/labeling.h"
#include "tracker/backoff.h"
#include "tracker/feature_finder.h"
#include "tracker/piece_search.h"
#include "view/view_measurements.h"

namespace softbody {

/// What all guesses of one frame have in common.
struct GuessedBody {
  std::shared_ptr<const SurfaceModel> model;
  const ViewSettings& settings;
  const MeasurementWeights& weights;
  double usual_error_m;  ///< of the prediction
  SoughtFeatures sought;
  const LabelMemory& last_labels;  ///< of the last frame; empty: none
  RasterMemory* memory;
};

/// A guess where the body is, and the features that the frame shows there, with outliers marked.
struct Guess {
  View view;
  Labels labels;
  FoundFeatures features;
};

/// A guess and the motions of the pieces that align it with the frame.
struct AlignedGuess {
  Guess guess;
  RigidMotions motions;
};

/// Labels of a frame for one of its views.
Labels labelsOf(const GuessedBody& body, const View& view);
/// The same, but nothing beside the rendered body shows it.
Labels silhouetteLabels(const GuessedBody& body, const View& view);

/// Guesses where the body is in a frame. The first guess is the prediction. If most features are not found
/// there, the second one is where the features and the depth around the prediction take it. If a piece is
/// still missing, the next ones have it where it is recognised. Every guess is rendered once.
/// It keeps from frame to frame when to search the whole image again.
class Guesses {
 public:
  /// The best guess. @param prediction the rendered prediction.
  Guess best(const GuessedBody& body, View prediction);

  /// To be called when the body has other pieces.
  void forgetPieces() { piece_search_.reset(); }
  void reset();

  /// Aligns a guess. What moves far is rendered and labelled again in its new place, with the same features,
  /// and aligned once more.
  static AlignedGuess aligned(const GuessedBody& body, Guess guess);

 private:
  Guess guessAt(const GuessedBody& body, View view) const;
  Guess guessAt(const GuessedBody& body, const Points& vertices) const;
  Guess movedGuess(const GuessedBody& body, Guess guess);
  Guess withPiecesFound(const GuessedBody& body, const std::vector<bool>& due, Guess guess);

  FeatureFinder finder_;
  Backoff wide_search_;
  PieceSearch piece_search_;
};

}  // namespace softbody
