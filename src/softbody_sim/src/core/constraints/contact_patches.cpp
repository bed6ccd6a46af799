#include "constraints/contact_patches.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace softbody {
namespace {

/// Disjoint sets of points.
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  std::size_t rootOf(std::size_t k) {
    while (parents_[k] != k) k = parents_[k] = parents_[parents_[k]];
    return k;
  }
  /// The smaller number becomes the root.
  void join(std::size_t a, std::size_t b) {
    a = rootOf(a), b = rootOf(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parents_;
};

/// Points whose places share a vertex lie on triangles that touch.
Groups connected(const std::vector<PointForce>& points, const Tets& tets) {
  Groups groups(points.size());
  std::map<std::pair<int, int>, std::size_t> first;  // of an obstacle and a vertex
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (int corner = 0; corner < 4; ++corner) {
      if (points[k].place.barycentric[corner] == 0.0) continue;
      const int vertex = tets(points[k].place.tet, corner);
      groups.join(k, first.emplace(std::make_pair(points[k].obstacle, vertex), k).first->second);
    }
  }
  return groups;
}

}  // namespace

std::vector<ContactPatch> patchesOf(const std::vector<PointForce>& points, const Tets& tets) {
  Groups groups = connected(points, tets);
  std::map<std::size_t, ContactPatch> patches;
  std::map<std::size_t, double> weights;  // sum of the forces' sizes [N]
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PointForce& point = points[k];
    const double weight = point.force.norm();
    ContactPatch& patch = patches.emplace(groups.rootOf(k), ContactPatch()).first->second;
    if (weights.emplace(groups.rootOf(k), 0.0).second) patch.normal.setZero();
    weights[groups.rootOf(k)] += weight;
    patch.obstacle = point.obstacle;
    patch.place += weight * point.position;
    patch.normal += weight * point.normal;
    patch.force += point.force;
    patch.torque += point.position.cross(point.force);
  }
  std::vector<ContactPatch> result;
  for (auto& [root, patch] : patches) {
    patch.place /= weights.at(root);
    patch.normal.normalize();
    patch.torque -= patch.place.cross(patch.force);
    result.push_back(patch);
  }
  return result;
}

}  // namespace softbody
