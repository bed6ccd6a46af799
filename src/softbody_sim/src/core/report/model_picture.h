#pragma once

#include <opencv2/core.hpp>

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// The visual mesh, the cage and the far half of the tets side by side, as in Kang et al. 2022, figure 3. z
/// points up; drawn without a display. @return BGR.
cv::Mat3b drawModel(const ObjectModel& model);

}  // namespace softbody
