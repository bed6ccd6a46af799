#pragma once

#include <memory>
#include <vector>

namespace softbody {

struct TetEdit;

/// Edits of the tets of a body, each of the tets after the one before.
using TetEdits = std::vector<std::shared_ptr<const TetEdit>>;

}  // namespace softbody
