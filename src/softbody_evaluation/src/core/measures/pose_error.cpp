#include "softbody_evaluation/measures/pose_error.h"

namespace softbody::evaluation {

PoseErrorReport poseError(const PoseRecord& result, const PoseRecord& truth) {
  PoseErrorReport report;
  report.expected = truth.size();
  std::vector<float> positions, rotations;
  for (const auto& [stamp, expected] : truth) {
    const auto answer = result.find(stamp);
    if (answer == result.end()) continue;
    const Eigen::Isometry3d difference = expected.inverse() * answer->second;
    positions.push_back(static_cast<float>(difference.translation().norm()));
    rotations.push_back(static_cast<float>(Eigen::AngleAxisd(difference.rotation()).angle()));
  }
  report.answered = positions.size();
  report.position = summarize(std::move(positions));
  report.rotation = summarize(std::move(rotations));
  return report;
}

}  // namespace softbody::evaluation
