#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/load_estimate.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Standard deviation of each vertex's distance from its true position [m], in all three directions:
///
///   variance = that of the posterior + (misfit of the targets around)^2 + 3 (residual of the targets)^2
///
/// The posterior knows the unknown loads. What the targets still differ from the body by is noise and shape
/// that the model cannot take; the residual is its root mean square in one direction.
/// @param targets that acted. @param vertices after the step, #V by 3 [m].
void standardDeviations(const std::vector<Target>& targets, const Tets& tets, const Points& vertices,
                        const ShapePosterior& posterior, std::vector<float>* deviations);

/// Confidence and standard deviation after a time without an image.
void fadeUnobserved(double elapsed_s, MeshState* state);

}  // namespace softbody
