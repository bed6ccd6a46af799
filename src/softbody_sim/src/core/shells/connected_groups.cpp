#include "shells/connected_groups.h"

#include <algorithm>
#include <numeric>

namespace softbody {
namespace {

/// The first member of i's group. Halves the path to it.
std::size_t firstOf(std::size_t i, std::vector<std::size_t>* parents) {
  std::vector<std::size_t>& p = *parents;
  while (p[i] != i) i = p[i] = p[p[i]];
  return i;
}

}  // namespace

std::vector<std::vector<std::size_t>> connectedGroups(
    std::size_t count, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
  std::vector<std::size_t> parents(count);
  std::iota(parents.begin(), parents.end(), 0);
  for (const auto& [a, b] : pairs) {
    const auto [first, second] = std::minmax({firstOf(a, &parents), firstOf(b, &parents)});
    parents[second] = first;
  }
  std::vector<std::size_t> numbers(count);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = firstOf(i, &parents);
    if (first == i) {
      numbers[i] = groups.size();
      groups.emplace_back();
    }
    groups[numbers[first]].push_back(i);
  }
  return groups;
}

}  // namespace softbody
