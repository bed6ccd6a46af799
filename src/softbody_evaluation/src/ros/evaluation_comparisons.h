#pragma once

#include "softbody_evaluation/report/report_folder.h"
#include "softbody_evaluation/ros/bags.h"
#include "softbody_evaluation/ros/evaluator.h"

namespace softbody::evaluation {

/// The result against the recording, frame by frame: frames answered, depth residuals, silhouettes (against
/// the truth's, if there is a truth) and overlays.
void compareWithRecording(const EvaluatorOptions& options, const std::string& recording,
                          const SurfaceRecord& result, const SurfaceRecord* truth, Report* report,
                          Pictures* pictures);

/// The result against the truth: frames answered, vertex errors, pieces, jitter.
/// @param result in the truth's frame. @param unhidden likewise, if nothing had ever hidden the body; may be
/// null.
void compareWithTruth(const EvaluatorOptions& options, const SurfaceRecord& result,
                      const SurfaceRecord& truth, const SurfaceRecord* unhidden, Report* report,
                      Pictures* pictures);

}  // namespace softbody::evaluation
