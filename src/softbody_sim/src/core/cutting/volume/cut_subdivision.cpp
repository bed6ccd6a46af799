#include "cutting/volume/cut_subdivision.h"

#include <Eigen/Dense>
#include <algorithm>

#include "cutting/patch/cut_patch.h"

namespace softbody {
namespace {

using Flags = std::vector<bool>;

std::size_t nearEndOf(const EdgeCrossing& crossing) { return static_cast<std::size_t>(crossing.nearEnd()); }

CutSubdivision splitOffCutEdges(const Points& vertices, const Tets& tets,
                                const std::vector<EdgeCrossing>& crossings, const Flags& on_cut) {
  CutSubdivision result;
  std::vector<EdgeSplit> splits;
  for (const EdgeCrossing& crossing : crossings) {
    if (on_cut[static_cast<std::size_t>(crossing.a)] || on_cut[static_cast<std::size_t>(crossing.b)])
      continue;
    splits.push_back({crossing.a, crossing.b, static_cast<int>(vertices.rows() + splits.size())});
    result.splits.push_back(crossing);
  }
  result.vertices.resize(vertices.rows() + static_cast<Eigen::Index>(splits.size()), 3);
  result.vertices.topRows(vertices.rows()) = vertices;
  for (std::size_t s = 0; s < splits.size(); ++s) {
    const EdgeCrossing& c = result.splits[s];
    result.vertices.row(splits[s].vertex) = (1.0 - c.t) * vertices.row(c.a) + c.t * vertices.row(c.b);
  }
  result.vertices = inSinglePrecision(result.vertices);
  result.parts = bisectEdges(tets, splits);
  return result;
}

/// Among the crossings of a part's new vertices, the one nearest to an end of its edge.
const EdgeCrossing& tightestSplit(const CutSubdivision& subdivision, Eigen::Index part, int old_count) {
  const EdgeCrossing* tightest = nullptr;
  for (const int vertex : subdivision.parts.tets.row(part)) {
    if (vertex < old_count) continue;
    const EdgeCrossing& split = subdivision.splits[static_cast<std::size_t>(vertex - old_count)];
    if (tightest == nullptr || split.fraction() < tightest->fraction()) tightest = &split;
  }
  return *tightest;
}

/// Puts an end of an edge on the cut for every sliver. @return whether there was a sliver.
bool snapSlivers(const CutSubdivision& subdivision, int old_count, const SubdivisionSettings& settings,
                 const Flags& spared, Flags* on_cut) {
  bool any = false;
  for (Eigen::Index part = 0; part < subdivision.parts.tets.rows(); ++part) {
    const Eigen::RowVector4i tet = subdivision.parts.tets.row(part);
    if (tet.maxCoeff() < old_count) continue;
    const double quality = tetQuality(subdivision.vertices, tet);
    if (quality >= settings.least_quality) continue;
    const std::size_t end = nearEndOf(tightestSplit(subdivision, part, old_count));
    if (spared[end] && quality >= settings.worst_quality) continue;
    (*on_cut)[end] = true;
    any = true;
  }
  return any;
}

}  // namespace

double tetQuality(const Points& vertices, const Eigen::RowVector4i& tet) {
  Eigen::Vector3d corner[4];
  for (int k = 0; k < 4; ++k) corner[k] = vertices.row(tet[k]);
  double largest_area = 0.0, longest = 0.0;  // doubled; squared
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d &p = corner[(k + 1) % 4], &q = corner[(k + 2) % 4], &r = corner[(k + 3) % 4];
    largest_area = std::max(largest_area, (q - p).cross(r - p).norm());
    for (int j = 0; j < k; ++j) longest = std::max(longest, (corner[k] - corner[j]).squaredNorm());
  }
  const double volume = (corner[1] - corner[0]).cross(corner[2] - corner[0]).dot(corner[3] - corner[0]);
  return volume / (largest_area * std::sqrt(longest));
}

CutSubdivision subdivide(const Points& vertices, const Tets& tets, const std::vector<EdgeCrossing>& crossings,
                         const SubdivisionSettings& settings, std::vector<bool> on_cut,
                         const std::vector<bool>& spared) {
  for (const EdgeCrossing& crossing : crossings) {
    const std::size_t end = nearEndOf(crossing);
    if (crossing.fraction() < settings.snap_fraction && !spared[end]) on_cut[end] = true;
  }
  const auto old_count = static_cast<int>(vertices.rows());
  CutSubdivision result = splitOffCutEdges(vertices, tets, crossings, on_cut);
  while (snapSlivers(result, old_count, settings, spared, &on_cut)) {
    result = splitOffCutEdges(vertices, tets, crossings, on_cut);
  }
  on_cut.resize(static_cast<std::size_t>(result.vertices.rows()), true);
  result.on_cut = std::move(on_cut);
  return result;
}

}  // namespace softbody
