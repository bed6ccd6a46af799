#pragma once

#include "report/pictures.h"
#include "softbody_evaluation/comparison/evaluator_options.h"
#include "softbody_evaluation/records/surface_record.h"
#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// Compares the result with the truth: frames answered, vertex errors, pieces, jitter, volume.
/// @param result in the truth's frame, with its material (mapMaterial).
/// @param unhidden result for the same motion without occluders, in the truth's frame; may be null.
/// @throw std::invalid_argument if no frame has a state of the unhidden body.
void compareWithTruth(const EvaluatorOptions& options, const SurfaceRecord& result,
                      const SurfaceRecord& truth, const SurfaceRecord* unhidden, Report* report,
                      Pictures* pictures);

/// The errors of predicted states. @param result, truth as above, from the first predicted state on.
/// @throw std::invalid_argument if no frame has a state.
OpenLoopReport compareOpenLoop(const EvaluatorOptions& options, const SurfaceRecord& result,
                               const SurfaceRecord& truth);

}  // namespace softbody::evaluation
