#include "search_report/search_report.h"

#include "registration/search_anywhere.h"
#include "registration/search_near_pose.h"
#include "search_report/search_measurement.h"

namespace softbody {

SearchReport searchForBody(const RgbdFrame& frame, const TriangleMesh& rest_surface,
                           const std::optional<Eigen::Isometry3d>& initial_pose,
                           const RegistrationConfig& config) {
  const SearchMeshes meshes = makeSearchMeshes(rest_surface);
  const RegionColors colors;
  std::optional<RoughPose> rough;
  std::vector<Eigen::Isometry3d> guesses;
  SearchOutcome outcome;
  if (initial_pose) {
    rough = roughPose(*initial_pose, config);
    outcome = searchNearAccepted(frame, meshes, *rough, config);
    guesses.push_back(*initial_pose);
  }
  const bool anywhere = !rough || (config.anywhere && !outcome.found);
  const auto unknown = [](const Eigen::Isometry3d&) { return -1.0; };  // no features are known
  if (anywhere) outcome = searchAnywhere(frame, colors, meshes, guesses, unknown, config);
  if (anywhere) rough.reset();
  SearchReport report = measureSearch(frame, colors, meshes, outcome, rough, config);
  report.found = outcome.found.has_value();
  if (outcome.found) {
    report.pose = outcome.found->pose;
    report.alike = outcome.found->alike;
    return report;
  }
  report.fitting_scale = fittingScale(frame, colors, meshes, outcome.best, config);
  return report;
}

}  // namespace softbody
