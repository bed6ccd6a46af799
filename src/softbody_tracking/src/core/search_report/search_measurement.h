#pragma once

#include <optional>

#include "labels/region_colors.h"
#include "registration/coarse_mesh.h"
#include "registration/found_pose.h"
#include "registration/rough_pose.h"
#include "search_report/search_report.h"

namespace softbody {

/// Measures a search. @param outcome with its best pose; empty: no pose was tried. `fitting_scale` stays
/// empty, and `found` false. @param rough the body was sought only near this pose; empty: anywhere.
SearchReport measureSearch(const RgbdFrame& frame, const RegionColors& colors, const SearchMeshes& meshes,
                           const SearchOutcome& outcome, const std::optional<RoughPose>& rough);

/// The factor by which the mesh would have to be scaled so that the body is found: the size of the part at
/// the best pose divided by the size of the mesh there, or the factor between two units of length. Empty if
/// no such mesh would be found. Takes as long as a few searches.
/// @param best pose of the search that failed; empty: no pose was tried.
std::optional<double> fittingScale(const RgbdFrame& frame, const RegionColors& colors,
                                   const SearchMeshes& meshes, const std::optional<PoseHypothesis>& best);

}  // namespace softbody
