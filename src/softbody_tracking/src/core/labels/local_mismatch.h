#pragma once

#include <optional>
#include <string>
#include <vector>

#include "labels/labels.h"
#include "prediction/predicted_surface.h"

namespace softbody {

/// A patch of the predicted surface where the image shows the background.
struct LocalMismatch {
  double width_m = 0.0;  ///< of the patch, at its widest circle: the surface is at least so far off [m]
  std::string side;      ///< of the body in the image: left, right, upper or lower
};

/// The widest patch whose width exceeds what the tracker expects there: the prediction's usual error, the
/// deviation of the outline in this frame and that of the state, all one standard deviation.
/// None in a frame without an outline: what its labels are worth is then not measured.
/// @param usual_error_m of predictions in the last frames.
/// @param outline_px deviation of the outline in this frame [px]; 0: not measured.
/// @param deviations of the volume's vertices [m]; empty: not estimated.
std::optional<LocalMismatch> localMismatch(const Labels& labels, const PredictedSurface& surface,
                                           double usual_error_m, double outline_px,
                                           const std::vector<float>& deviations);

/// Size of the body in the image over that of the prediction, by their areas. What is hidden or unknown does
/// not count.
double imageScale(const Labels& labels, const PredictedSurface& surface);

}  // namespace softbody
