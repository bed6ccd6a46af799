#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

using PoseRecord = std::map<Nanoseconds, Eigen::Isometry3d>;  ///< by stamp

/// A tool's poses, as a bag holds them.
struct ToolRecord {
  std::string frame_id;  ///< of the poses
  PoseRecord poses;
  std::vector<std::string> notes;  ///< what was left out, in sentences
};

/// Errors of a tool's poses.
struct PoseErrorReport {
  std::size_t expected = 0, answered = 0;  ///< true poses; true poses with a result of the same stamp
  Summary position;                        ///< [m]
  Summary rotation;                        ///< [rad]
};

PoseErrorReport poseError(const PoseRecord& result, const PoseRecord& truth);

}  // namespace softbody::evaluation
