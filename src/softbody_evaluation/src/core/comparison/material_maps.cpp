#include "comparison/material_maps.h"

#include <algorithm>
#include <utility>

#include "comparison/other_mesh.h"
#include "measures/material_match.h"
#include "measures/rest_symmetry.h"
#include "softbody_evaluation/measures/vertex_match.h"

namespace softbody::evaluation {
namespace {

bool isCut(const MeshTopology& topology) {
  return std::find(topology.cut.begin(), topology.cut.end(), true) != topology.cut.end();
}

bool isTracked(TrackingState state) {
  return state == TrackingState::kTracking || state == TrackingState::kDegraded;
}

/// A result and its truth in one frame, both uncut.
struct UncutPair {
  const MeshTopology* mesh = nullptr;  ///< the truth's
  Points rest, result, truth;          ///< rows of the vertices that both have [m]
};

std::optional<UncutPair> uncutPairAt(Nanoseconds stamp, const SurfaceRecord& result,
                                     const SurfaceRecord& truth) {
  const auto answer = result.states.find(stamp), expected = truth.states.find(stamp);
  if (answer == result.states.end() || expected == truth.states.end()) return std::nullopt;
  const MeshTopology& mine = topologyOf(result, answer->second);
  const MeshTopology& its = topologyOf(truth, expected->second);
  if (isCut(mine) || isCut(its) || !sameMesh(mine, its)) return std::nullopt;
  const std::vector<int> matches = matchVertices(mine.vertex_parents, its.vertex_parents);
  std::vector<int> rows, true_rows;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    rows.push_back(static_cast<int>(i));
    true_rows.push_back(matches[i]);
  }
  return UncutPair{&its, its.rest_vertices(true_rows, Eigen::all), answer->second.vertices(rows, Eigen::all),
                   expected->second.vertices(true_rows, Eigen::all)};
}

double angleOf(const Eigen::Isometry3d& motion) { return Eigen::AngleAxisd(motion.linear()).angle(); }

/// Compares the pose that the tracker took with the true pose.
class AlikeComparison {
 public:
  void add(Nanoseconds first, int poses, const UncutPair& pair, SurfaceRecord* result) {
    const TriangleMesh mesh{pair.mesh->rest_vertices, pair.mesh->triangles};
    const Eigen::Isometry3d taken = motionBetween(pair.rest, pair.result, pair.truth);
    const SelfMap map = nearestSelfMap(mesh, taken);
    const bool same_shape = isSymmetry(map, mesh);
    MaterialMap material = same_shape ? materialMap(map.motion, *pair.mesh, *pair.mesh) : MaterialMap();
    material.first = first;
    result->material.push_back(std::move(material));
    const AlikePoses found{poses, true, same_shape, angleOf(same_shape ? map.motion : taken)};
    const auto badness = [](const AlikePoses& a) { return std::make_pair(!a.same_shape, a.turn_rad); };
    if (!worst_ || !worst_->compared || badness(found) > badness(*worst_)) worst_ = found;
  }

  /// Without a truth in that frame.
  void add(int poses) {
    if (!worst_) worst_ = AlikePoses{poses, false, true, 0.0};
  }

  const std::optional<AlikePoses>& worst() const { return worst_; }

 private:
  std::optional<AlikePoses> worst_;
};

}  // namespace

std::optional<AlikePoses> mapMaterial(const std::string& bag, const std::vector<StatusRecord>& statuses,
                                      const SurfaceRecord* truth, SurfaceRecord* result) {
  if (truth != nullptr && !isSameMesh(*result, *truth)) return mapOtherMesh(bag, statuses, *truth, result);
  AlikeComparison comparison;
  bool tracked = false, compared = false;
  Nanoseconds found = 0;  // when the tracker found the body last; the first time it counts from the start
  for (const StatusRecord& status : statuses) {
    const bool lost = tracked && !isTracked(status.state);
    if (lost) compared = false;
    if (!tracked && isTracked(status.state)) found = result->material.empty() ? 0 : status.stamp;
    tracked = isTracked(status.state);
    if (!tracked || status.alike < 2 || compared) continue;
    comparison.add(status.alike);
    if (truth == nullptr) continue;
    const std::optional<UncutPair> pair = uncutPairAt(status.stamp, *result, *truth);
    if (!pair) continue;
    comparison.add(found, status.alike, *pair, result);
    compared = true;
  }
  return comparison.worst();
}

}  // namespace softbody::evaluation
