#include "cutting/volume/manifold.h"

#include <algorithm>
#include <tuple>

namespace softbody {
namespace {

/// A triangle at one of its vertices: its edge on the border of the vertex's fan.
struct FanStep {
  int vertex, from, to;
  bool operator<(const FanStep& other) const {
    return std::tie(vertex, from, to) < std::tie(other.vertex, other.from, other.to);
  }
};

using Steps = std::vector<FanStep>::const_iterator;

/// Whether the steps of one vertex, ascending, form one closed loop without repetition.
bool isOneLoop(Steps begin, Steps end) {
  Steps at = begin;
  for (Steps counter = begin; counter != end; ++counter) {
    if (counter + 1 != end && counter->from == (counter + 1)->from) return false;
    const int next = at->to;
    at = std::lower_bound(begin, end, next, [](const FanStep& step, int v) { return step.from < v; });
    if (at == end || at->from != next) return false;
    if (at == begin) return counter + 1 == end;
  }
  return false;
}

}  // namespace

std::vector<int> nonManifoldVertices(const Triangles& triangles) {
  std::vector<FanStep> steps;
  steps.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      steps.push_back({triangles(f, k), triangles(f, (k + 1) % 3), triangles(f, (k + 2) % 3)});
    }
  }
  std::sort(steps.begin(), steps.end());
  std::vector<int> found;
  for (Steps begin = steps.begin(); begin != steps.end();) {
    const Steps end =
        std::find_if(begin, steps.cend(), [begin](const FanStep& s) { return s.vertex != begin->vertex; });
    if (!isOneLoop(begin, end)) found.push_back(begin->vertex);
    begin = end;
  }
  return found;
}

}  // namespace softbody
