#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// Intersection over union of the pixels above zero; 1 if both are empty.
/// @throw std::invalid_argument if the masks differ in size.
double intersectionOverUnion(const cv::Mat1b& a, const cv::Mat1b& b);

/// The mask of a rendered depth image.
cv::Mat1b silhouette(const cv::Mat1f& rendered_depth);

/// The mask of measured depth within `margin_m` of the model's depth range, up to 15 pixels beside the model.
/// The background must be distant or unmeasured. Things that touch the body count as body.
cv::Mat1b measuredSilhouette(const cv::Mat1f& measured, const cv::Mat1f& model, double margin_m);

struct SilhouetteReport {
  bool against_truth = false;  ///< if false, against the measured depth
  std::size_t frames = 0;
  double mean = 0.0, worst = 0.0;  ///< IoU, 0..1
  std::vector<double> values;      ///< per frame
};

SilhouetteReport summarizeSilhouettes(const std::vector<double>& values, bool against_truth);

}  // namespace softbody::evaluation
