#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/status_record.h"
#include "softbody_evaluation/records/surface_record.h"
#include "softbody_evaluation/report/alike_poses.h"

namespace softbody::evaluation {

/// Sets SurfaceRecord::material where the tracker said that poses look alike and the mesh does look the same
/// in the pose that it took. It starts again where the tracker found an uncut body again. If the truth has
/// another mesh, the material of the result is found by the two rest shapes; the record's notes say so.
/// @param statuses in order of the stamps. @param truth null: nothing is compared.
/// @param bag of the result, for errors. @throw std::invalid_argument if the meshes are not of one body.
/// @return what the tracker said; empty if it never said so. A pose in which the mesh differs stays an error.
std::optional<AlikePoses> mapMaterial(const std::string& bag, const std::vector<StatusRecord>& statuses,
                                      const SurfaceRecord* truth, SurfaceRecord* result);

}  // namespace softbody::evaluation
