#include "core/cutting/cut_subdivision.h"

#include <Eigen/Dense>
#include <algorithm>

#include "core/cutting/cut_patch.h"

namespace softbody {
namespace {

using Flags = std::vector<bool>;

void flagNearEnd(const EdgeCrossing& crossing, Flags* on_cut) {
  (*on_cut)[static_cast<std::size_t>(crossing.nearEnd())] = true;
}

CutSubdivision splitWhatIsNotTaken(const Points& vertices, const Tets& tets,
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

/// Takes the nearest end among the crossings that gave a part its new vertices.
void takeWorstSplit(const CutSubdivision& subdivision, Eigen::Index part, int old_count, Flags* on_cut) {
  const EdgeCrossing* worst = nullptr;
  for (const int vertex : subdivision.parts.tets.row(part)) {
    if (vertex < old_count) continue;
    const EdgeCrossing& split = subdivision.splits[static_cast<std::size_t>(vertex - old_count)];
    if (worst == nullptr || split.fraction() < worst->fraction()) worst = &split;
  }
  flagNearEnd(*worst, on_cut);
}

/// Takes an end for every part that came out a sliver. @return whether there was one.
bool takeSplitsOfSlivers(const CutSubdivision& subdivision, const Tets& tets, double least_quality,
                         Flags* on_cut) {
  const int old_count =
      static_cast<int>(subdivision.vertices.rows() - static_cast<Eigen::Index>(subdivision.splits.size()));
  bool any = false;
  for (Eigen::Index part = 0; part < subdivision.parts.tets.rows(); ++part) {
    const Eigen::RowVector4i tet = subdivision.parts.tets.row(part);
    if (part < tets.rows() && tet == tets.row(part)) continue;
    if (tet.maxCoeff() < old_count || tetQuality(subdivision.vertices, tet) >= least_quality) continue;
    takeWorstSplit(subdivision, part, old_count, on_cut);
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
                         const SubdivisionSettings& settings, std::vector<bool>* on_cut) {
  for (const EdgeCrossing& crossing : crossings) {
    if (crossing.fraction() < settings.snap_fraction) flagNearEnd(crossing, on_cut);
  }
  CutSubdivision result = splitWhatIsNotTaken(vertices, tets, crossings, *on_cut);
  while (takeSplitsOfSlivers(result, tets, settings.least_quality, on_cut)) {
    result = splitWhatIsNotTaken(vertices, tets, crossings, *on_cut);
  }
  on_cut->resize(static_cast<std::size_t>(result.vertices.rows()), true);
  return result;
}

}  // namespace softbody
