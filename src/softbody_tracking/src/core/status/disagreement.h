#pragma once

#include <optional>
#include <string>
#include <vector>

#include "labels/labels.h"
#include "prediction/association.h"
#include "prediction/predicted_surface.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// A patch of the body that the frame shows elsewhere than predicted.
struct Disagreement {
  enum class Kind {
    kBackground,  ///< the background shows where the body is predicted
    kBehind,      ///< the body is measured behind its prediction
    kBeyond       ///< the body shows beyond its predicted outline
  };
  Kind kind = Kind::kBackground;
  double error_m = 0.0;   ///< the surface is at least so far off there; 0: nothing disagrees
  std::string side = {};  ///< of the body in the image: left, right, upper or lower
};

/// The frame and the prediction that it is compared with.
struct ComparedBody {
  const Labels& labels;
  const PredictedSurface& surface;
  const cv::Mat1f& depth;                ///< of the frame [m]
  double outline_px;                     ///< deviation of the frame's outline [px]; 0: not measured
  const std::vector<float>& deviations;  ///< of the volume's vertices [m]; empty: not estimated
};

/// The patch that is farthest off: the width of a patch of background or of body, or the mean distance of the
/// measured surface behind the predicted one. Something before the body is no error. What shows beyond the
/// outline may be something that looks like the body: it counts only if neither the outline's deviation nor
/// the state's explains it.
Disagreement largestDisagreement(const ComparedBody& body);

/// Mean of the last frames' largest disagreements: a prediction that is off in one frame, as in a sudden
/// motion, is corrected in the next one.
class MeanDisagreement {
 public:
  /// @param newest of the frame. @return the mean, with kind and side of the last one that is not below it.
  const Disagreement& add(const Disagreement& newest, Nanoseconds stamp);

  void reset() { *this = {}; }

 private:
  Disagreement mean_;
  std::optional<Nanoseconds> stamp_;  ///< of the last frame
};

/// Half of the places that the frame shows are within this distance of their true positions with 90 %
/// probability, or their distances are unknown [m]; 0 if no deviations are estimated.
/// @param shown measurements of the frame. @param deviations of the volume's vertices [m].
double medianBound(const std::vector<Association>& shown, const TetTopology& volume,
                   const std::vector<float>& deviations);

/// Size of the body in the image over that of the prediction, by their areas. What is hidden or unknown does
/// not count.
double imageScale(const Labels& labels, const PredictedSurface& surface);

}  // namespace softbody
