#pragma once

#include <softbody_msgs/Predict.h>

#include <Eigen/Core>
#include <set>
#include <string>

#include "softbody_sim/prediction/prediction.h"

namespace softbody {

/// @param most_steps of all plans together.
/// @throw std::invalid_argument if times are not ascending, or there are too many of something.
void requireUsable(const softbody_msgs::PredictRequest& request, double most_steps);

/// Each is looked up while the node waits. @throw std::invalid_argument.
void requireFewFrames(const std::set<std::string>& frames);

/// @param vertex_count of the volume. @throw std::invalid_argument if the answer is too long.
void requireAnswerFits(const softbody_msgs::PredictRequest& request, Eigen::Index vertex_count);

/// @return [s].
double timeStepOf(const softbody_msgs::PredictRequest& request);

softbody_msgs::PredictedState toMessage(const PredictedState& state);

}  // namespace softbody
