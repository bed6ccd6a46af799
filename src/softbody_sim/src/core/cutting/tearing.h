#pragma once

#include <optional>
#include <vector>

#include "core/cutting/tet_edit.h"
#include "softbody_common/types.h"

namespace softbody {

/// Inner faces that are stretched apart: the Green strain of their two tets, averaged, exceeds the limit
/// along the face's normal. Ascending. @param vertices deformed, #V by 3 [m].
std::vector<Face> overstrainedFaces(const TetTopology& topology, const Points& vertices, double strain_limit);

/// Tears the tets along the faces that are stretched beyond the limit, and along those of earlier calls that
/// were still held together. Tets are not subdivided: the tear is as fine as they are.
/// @param cut per triangle of the topology's surface, as in TetEdit; @param closed_faces of earlier calls for
/// this topology, ascending; afterwards for the edit's. @return nothing if nothing opens.
std::optional<TetEdit> tearTets(const TetTopology& topology, const std::vector<bool>& cut,
                                const Points& vertices, double strain_limit, std::vector<Face>* closed_faces);

}  // namespace softbody
