#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/status_record.h"
#include "softbody_evaluation/records/surface_record.h"
#include "softbody_evaluation/report/alike_poses.h"

namespace softbody::evaluation {

/// Whether result and truth are made from one mesh file.
bool isSameMesh(const SurfaceRecord& result, const SurfaceRecord& truth);

/// Sets SurfaceRecord::material for a result of another mesh of the same body, such as a scan: the rest
/// surface is laid onto the true one (fitModel), and each vertex belongs to the nearest place there. Where
/// the true surface looks the same after a turn, the turn is taken that the first tracked frame has. The
/// record's notes say so, and how far the two are apart.
/// @param bag of the result, for errors.
/// @return what the tracker said of poses that look alike; empty if it never said so.
/// @throw std::invalid_argument if the meshes are not of one body: the sizes differ by more than three times,
/// or the surfaces by more than 2 % of the diagonal (mean).
std::optional<AlikePoses> mapOtherMesh(const std::string& bag, const std::vector<StatusRecord>& statuses,
                                       const SurfaceRecord& truth, SurfaceRecord* result);

}  // namespace softbody::evaluation
