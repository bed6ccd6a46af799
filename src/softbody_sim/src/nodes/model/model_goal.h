#pragma once

#include <softbody_msgs/PrepareModelGoal.h>

#include "softbody_sim/report/model_folder.h"

namespace softbody {

/// The mesh of a goal. @throw std::invalid_argument with the field, its value and the allowed values.
ModelSource sourceOf(const softbody_msgs::PrepareModelGoal& goal);

/// Number of cage vertices and no cache. @throw std::invalid_argument likewise.
VolumeSettings settingsOf(const softbody_msgs::PrepareModelGoal& goal);

}  // namespace softbody
