#pragma once

#include <map>
#include <string>
#include <vector>

#include "records/status_record.h"
#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/measures/stage_times.h"

namespace softbody::evaluation {

/// Reads poses of type PoseStamped or PoseWithCovarianceStamped. Empty if the topic is missing.
/// @throw std::invalid_argument if the topic has another type.
ToolRecord readPoses(const std::string& path, const std::string& topic);

/// Reads blades of type PolygonStamped: corners (#P by 3 [m]) by stamp. Empty if the topic is missing.
std::map<Nanoseconds, Points> readBlades(const std::string& path, const std::string& topic);

/// Reads times of type StageTiming. Empty if the topic is missing.
StageTimes readStageTimes(const std::string& path, const std::string& topic);

/// The TrackingStatus messages, in the order of the bag. Empty if the topic is missing.
/// @throw std::invalid_argument if the topic has another type or an unknown state.
std::vector<StatusRecord> readStatuses(const std::string& path, const std::string& topic);

}  // namespace softbody::evaluation
