#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// Intersection over union of the pixels above zero; 1 if both are empty.
/// @throw std::invalid_argument if the masks differ in size.
double intersectionOverUnion(const cv::Mat1b& a, const cv::Mat1b& b);

/// Where a rendered depth image shows something.
cv::Mat1b silhouette(const cv::Mat1f& rendered_depth);

/// Where something is measured at the model's depth, give or take `margin_m`, at most 15 pixels beside it: a
/// body before a distant or unmeasured background. What touches the body at its depth counts as body.
cv::Mat1b measuredSilhouette(const cv::Mat1f& measured, const cv::Mat1f& model, double margin_m);

struct SilhouetteReport {
  bool against_truth = false;  ///< otherwise against the measured depth
  std::size_t frames = 0;
  double mean = 0.0, worst = 0.0;  ///< IoU, 0..1
  std::vector<double> values;      ///< a frame
};

SilhouetteReport summarizeSilhouettes(const std::vector<double>& values, bool against_truth);

}  // namespace softbody::evaluation
