#pragma once

#include <string>

#include "softbody_common/protocol/camera_topics.h"

namespace softbody::evaluation {

/// What is compared, and the limits of the measures.
struct EvaluatorOptions {
  std::string result;            ///< bag
  std::string truth, recording;  ///< bags; empty: none
  std::string unhidden;          ///< bag with the result for the same motion without occluders; empty: none
  std::string report_folder;     ///< empty: no report is written
  std::string result_namespace = "/softbody";
  std::string truth_namespace = "/ground_truth";  ///< of the body's true surface, labels and forces
  CameraTopics camera = "/camera";
  double open_loop = 0.0;       ///< share of the frames at the end that the result predicts; 0: none
  double occluder_m = 0.03;     ///< see depthResidual
  int window = 100;             ///< frames of a row of the depth residual's table
  double near_cut_m = 0.01;     ///< largest distance of "vertices near a cut", at rest
  double cut_vertex_m = 0.002;  ///< largest distance at rest of matched vertices that a cut made
};

}  // namespace softbody::evaluation
