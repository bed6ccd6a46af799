#pragma once

#include <softbody_msgs/Predict.h>

#include "softbody_sim/prediction/prediction.h"

namespace softbody {

/// @throw std::invalid_argument if times are not ascending, or there are too many of something.
void requireUsable(const softbody_msgs::PredictRequest& request);

/// @return [s].
double timeStepOf(const softbody_msgs::PredictRequest& request);

softbody_msgs::PredictedState toMessage(const PredictedState& state);

}  // namespace softbody
