#pragma once

#include <optional>

#include "prediction/color_model.h"
#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "softbody_tracking/search_report/search_report.h"

namespace softbody {

/// Measures a search. @param best its best pose; empty: no pose was tried. `fitting_scale` stays empty, and
/// `found` false.
SearchReport measureSearch(const RgbdFrame& frame, const ColorModel& colors, const SearchMeshes& meshes,
                           const std::optional<PoseHypothesis>& best, const RegistrationConfig& config);

/// The factor by which the mesh would have to be scaled to fit near the best pose of a failed search: the
/// size of the part there, divided by the size of the mesh. Empty if the scaled mesh does not fit much
/// better.
std::optional<double> fittingScaleNear(const RgbdFrame& frame, const ColorModel& colors,
                                       const SearchMeshes& meshes, const PoseHypothesis& best,
                                       const RegistrationConfig& config);

/// The factor between two units of length with which the body would be found. Takes as long as one or two
/// searches.
std::optional<double> fittingUnit(const RgbdFrame& frame, const ColorModel& colors,
                                  const SearchMeshes& meshes, const RegistrationConfig& config);

}  // namespace softbody
