#pragma once

#include <string>

#include "softbody_bringup/evaluation/report.h"

namespace softbody::evaluation {

struct EvaluatorOptions {
  std::string result;            ///< bag
  std::string truth, recording;  ///< bags; empty: none
  std::string report_folder;     ///< empty: none is written
  std::string result_namespace = "/softbody", camera = "/camera";
  double occluder_m = 0.03;  ///< see depthResidual
  int window = 100;          ///< frames a row of the residual's table
};

/// Compares the result with the truth (vertices by stamp) and with the recording's depth, as far as these are
/// given, and writes report.json, plots and a contact sheet into the report folder.
/// @throw std::invalid_argument, rosbag::BagException with bag and topic if something is missing or does not
/// fit.
Report evaluate(const EvaluatorOptions& options);

}  // namespace softbody::evaluation
