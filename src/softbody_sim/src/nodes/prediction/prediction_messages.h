#pragma once

#include <softbody_msgs/Predict.h>

#include <vector>

#include "nodes/prediction/named_surroundings.h"
#include "softbody_sim/dynamics/prediction.h"

namespace softbody {

/// @throw std::invalid_argument if times are not ascending, or there are too many of something.
void requireUsable(const softbody_msgs::PredictRequest& request);

/// @return [s].
double timeStepOf(const softbody_msgs::PredictRequest& request);

/// @throw std::invalid_argument if a name is unknown, or a path cannot be used.
MotionPlan fromMessage(const softbody_msgs::MotionPlan& message, const NamedSurroundings& present);

/// @param present in the same order as the surroundings of the state.
softbody_msgs::PredictedState toMessage(const PredictedState& state, const NamedSurroundings& present);

}  // namespace softbody
