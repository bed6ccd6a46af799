#include "cutting/volume/edge_bisection.h"

#include <algorithm>
#include <unordered_map>

namespace softbody {
namespace {

std::uint64_t edgeKey(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

/// Finds the split edges of a tet: their indices in `splits`, ascending.
class SplitsOfTet {
 public:
  explicit SplitsOfTet(const std::vector<EdgeSplit>& splits) {
    numbers_.reserve(splits.size());
    for (std::size_t s = 0; s < splits.size(); ++s) {
      numbers_.emplace(edgeKey(splits[s].a, splits[s].b), static_cast<int>(s));
      for (const int end : {splits[s].a, splits[s].b}) {
        if (static_cast<std::size_t>(end) >= touched_.size())
          touched_.resize(static_cast<std::size_t>(end) + 1);
        touched_[static_cast<std::size_t>(end)] = true;
      }
    }
  }

  std::vector<int> operator()(const Eigen::RowVector4i& tet) const {
    std::vector<int> found;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        if (!touches(tet[i]) || !touches(tet[j])) continue;
        const auto number = numbers_.find(edgeKey(tet[i], tet[j]));
        if (number != numbers_.end()) found.push_back(number->second);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  bool touches(int vertex) const {
    return static_cast<std::size_t>(vertex) < touched_.size() && touched_[static_cast<std::size_t>(vertex)];
  }

  std::unordered_map<std::uint64_t, int> numbers_;
  std::vector<bool> touched_;  ///< per vertex: end of a split edge
};

/// Moves a corner of the tet to another vertex if the tet has both ends of the edge. @return whether it has.
bool moveCorner(Eigen::RowVector4i* tet, int from, int other, int to) {
  int* corner = std::find(tet->data(), tet->data() + 4, from);
  if (corner == tet->data() + 4 || std::find(tet->data(), tet->data() + 4, other) == tet->data() + 4)
    return false;
  *corner = to;
  return true;
}

/// All parts of a tet: each split edge halves the parts that it bounds.
std::vector<Eigen::RowVector4i> partsOf(const Eigen::RowVector4i& tet, const std::vector<int>& its_splits,
                                        const std::vector<EdgeSplit>& splits) {
  std::vector<Eigen::RowVector4i> parts{tet};
  for (const int s : its_splits) {
    const EdgeSplit& split = splits[static_cast<std::size_t>(s)];
    for (std::size_t k = 0, count = parts.size(); k < count; ++k) {
      Eigen::RowVector4i other = parts[k];
      if (!moveCorner(&other, split.a, split.b, split.vertex)) continue;
      moveCorner(&parts[k], split.b, split.a, split.vertex);
      parts.push_back(other);
    }
  }
  return parts;
}

}  // namespace

BisectedTets bisectEdges(const Tets& tets, const std::vector<EdgeSplit>& splits) {
  const SplitsOfTet splits_of(splits);
  BisectedTets result{tets, {}};
  std::vector<Eigen::RowVector4i> added;
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) result.parents.push_back(t);
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    const std::vector<int> its_splits = splits_of(tets.row(t));
    if (its_splits.empty()) continue;
    const std::vector<Eigen::RowVector4i> parts = partsOf(tets.row(t), its_splits, splits);
    result.tets.row(t) = parts.front();
    added.insert(added.end(), parts.begin() + 1, parts.end());
    result.parents.resize(result.parents.size() + parts.size() - 1, t);
  }
  result.tets.conservativeResize(tets.rows() + static_cast<Eigen::Index>(added.size()), Eigen::NoChange);
  for (std::size_t k = 0; k < added.size(); ++k) {
    result.tets.row(tets.rows() + static_cast<Eigen::Index>(k)) = added[k];
  }
  return result;
}

}  // namespace softbody
