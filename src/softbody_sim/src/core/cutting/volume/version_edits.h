#pragma once

#include <vector>

#include "cutting/volume/tet_edit.h"

/// Edits between versions of the tets of a body. A later version is made by cuts of an earlier one: vertices
/// keep their indices, and each tet lies in one earlier tet, its parent.
namespace softbody {

/// Per tet after a cut, its parent.
std::vector<int> parentsOf(const TetEdit& edit);

/// The edit from a version to a later one. @param cut of the later one, as in TetEdit.
TetEdit editForward(const TetTopology& earlier, const TetTopology& later, const std::vector<bool>& cut,
                    const std::vector<int>& parents);

/// The edit from a version back to an earlier one. @param cut of the earlier one, as in TetEdit.
TetEdit editBack(const TetTopology& later, const TetTopology& earlier, const std::vector<bool>& cut,
                 const std::vector<int>& parents);

}  // namespace softbody
