#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace softbody {

/// The connected components of the numbers 0 .. count - 1, whose edges are the pairs. Members of a component
/// ascend; components ascend by their first members.
std::vector<std::vector<std::size_t>> connectedGroups(
    std::size_t count, const std::vector<std::pair<std::size_t, std::size_t>>& pairs);

}  // namespace softbody
