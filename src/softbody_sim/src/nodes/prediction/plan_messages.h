#pragma once

#include <softbody_msgs/MotionPlan.h>

#include <set>
#include <string>
#include <vector>

#include "nodes/prediction/present.h"
#include "softbody_sim/prediction/motion_plan.h"

namespace softbody {

constexpr double kLongestPrediction_s = 60.0;  // 1800 steps; errors of the model grow with time

/// @throw std::invalid_argument if times are not ascending above 0, up to kLongestPrediction_s.
void requireAscending(const std::vector<double>& times, const std::string& what);

/// The tf frames that plans name, without leading slashes.
std::set<std::string> framesOf(const std::vector<softbody_msgs::MotionPlan>& plans);

/// @throw std::invalid_argument if a name is unknown or used twice, or if a path, a time, a box, a shape or a
/// frame cannot be used. The sentence begins with the entry of the plan.
MotionPlan fromMessage(const softbody_msgs::MotionPlan& message, const Present& present, double time_step_s);

}  // namespace softbody
