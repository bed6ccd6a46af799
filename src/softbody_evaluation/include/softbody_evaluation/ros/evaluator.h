#pragma once

#include <string>

#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

struct EvaluatorOptions {
  std::string result;            ///< bag
  std::string truth, recording;  ///< bags; empty: none
  std::string unhidden;          ///< bag with the result if nothing ever hid the body; empty: none
  std::string report_folder;     ///< empty: none is written
  std::string result_namespace = "/softbody", camera = "/camera";
  double occluder_m = 0.03;  ///< see depthResidual
  int window = 100;          ///< frames a row of the residual's table
  double near_cut_m = 0.01;  ///< what is near a cut, at rest
  double cut_vertex_m =
      0.002;  ///< a vertex made by a cut stands for a true one at most this far away at rest
};

/// Compares the result with the truth (vertices by stamp) and with the recording's depth, as far as these are
/// given. Writes report.json, report.html, plots and a contact sheet, which replace an earlier report as a
/// whole. A result in another frame is brought into the truth's or the camera's by the bags' /tf.
/// @throw std::invalid_argument, rosbag::BagException with bag and topic if something is missing or does not
/// fit.
Report evaluate(const EvaluatorOptions& options);

/// Two results of one recording.
struct Comparison {
  Report first, second;
};

/// The same for two results with the same truth and recording; one report folder shows both.
Comparison evaluateBoth(const EvaluatorOptions& options, const std::string& other_result);

/// Both reports, and their figures side by side.
nlohmann::json toJson(const Comparison& comparison);

}  // namespace softbody::evaluation
