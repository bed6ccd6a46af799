#include "cutting/patch/patch_intersector.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace softbody {
namespace {

constexpr int kLeafSize = 4;  // a box is about as dear to test as a few triangles

/// Six times the signed volume of the tet (a, b, p, q): its sign says on which side of the line p-q the line
/// a-b passes. Computed in ascending order of p and q, so that both triangles at an edge get the same number
/// with opposite signs.
double passing(const Eigen::Vector3d& a, const Eigen::Vector3d& ab, const Points& vertices, int p, int q) {
  const Eigen::Vector3d low = vertices.row(std::min(p, q)).transpose() - a;
  const Eigen::Vector3d high = vertices.row(std::max(p, q)).transpose() - a;
  const double volume = ab.dot(low.cross(high));
  return p < q ? volume : -volume;
}

/// Whether the line passes left of the directed edge. 0 counts as left for the ascending direction only.
bool passesLeft(double volume, int p, int q) { return volume > 0.0 || (volume == 0.0 && p < q); }

std::optional<PatchHit> hitOf(const TriangleMesh& mesh, int triangle, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b) {
  const int p = mesh.triangles(triangle, 0), q = mesh.triangles(triangle, 1), r = mesh.triangles(triangle, 2);
  const Eigen::Vector3d ab = b - a;
  const bool left = passesLeft(passing(a, ab, mesh.vertices, p, q), p, q);
  if (left != passesLeft(passing(a, ab, mesh.vertices, q, r), q, r)) return std::nullopt;
  if (left != passesLeft(passing(a, ab, mesh.vertices, r, p), r, p)) return std::nullopt;

  const Eigen::Vector3d corner = mesh.vertices.row(p);
  const Eigen::Vector3d first = mesh.vertices.row(q).transpose() - corner;
  const Eigen::Vector3d second = mesh.vertices.row(r).transpose() - corner;
  const Eigen::Vector3d normal = first.cross(second);
  const double height_a = normal.dot(a - corner), height_b = normal.dot(b - corner);
  if ((height_a < 0.0) == (height_b < 0.0)) return std::nullopt;
  return PatchHit{height_a / (height_a - height_b), triangle, height_a < 0.0};
}

/// Overlap test of a segment and a box, with separating axes.
struct SegmentOverlap {
  SegmentOverlap(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : center(0.5 * (a + b)), half(0.5 * (b - a)), reach(half.cwiseAbs()) {}

  bool operator()(const Eigen::AlignedBox3d& box) const {
    const Eigen::Vector3d size = 0.5 * box.sizes(), offset = box.center() - center;
    if (((offset.cwiseAbs() - size - reach).array() > 0.0).any()) return false;
    // Axes perpendicular to the segment; the margin covers rounding.
    const Eigen::Vector3d across = offset.cross(half).cwiseAbs();
    const double margin = 1e-12 * (reach.sum() + size.sum()) * (reach.sum() + size.sum());
    return across.x() <= size.y() * reach.z() + size.z() * reach.y() + margin &&
           across.y() <= size.x() * reach.z() + size.z() * reach.x() + margin &&
           across.z() <= size.x() * reach.y() + size.y() * reach.x() + margin;
  }

  Eigen::Vector3d center, half, reach;
};

}  // namespace

PatchIntersector::PatchIntersector(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  const auto count = static_cast<std::size_t>(mesh_.triangles.rows());
  boxes_.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    for (const int vertex : mesh_.triangles.row(static_cast<Eigen::Index>(f))) {
      boxes_[f].extend(mesh_.vertices.row(vertex).transpose());
    }
  }
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  if (count > 0) build(0, static_cast<int>(count));
}

void PatchIntersector::build(int first, int count) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centers;
  for (int k = first; k < first + count; ++k) {
    box.extend(boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    centers.extend(boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])].center());
  }
  nodes_[index].box = box;
  if (count <= kLeafSize) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return;
  }
  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [this, axis](int f, int g) {
    return boxes_[static_cast<std::size_t>(f)].center()[axis] <
           boxes_[static_cast<std::size_t>(g)].center()[axis];
  });
  build(first, count / 2);
  nodes_[index].first = static_cast<int>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

template <class Overlaps, class Visit>
void PatchIntersector::visit(const Overlaps& overlaps, const Visit& visit_triangle) const {
  if (nodes_.empty()) return;
  std::vector<int> open{0};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!overlaps(node.box)) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(index + 1);
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k)
      visit_triangle(order_[static_cast<std::size_t>(k)]);
  }
}

std::vector<PatchHit> PatchIntersector::hits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  std::vector<PatchHit> found;
  visit(SegmentOverlap(a, b), [&](int triangle) {
    if (const auto hit = hitOf(mesh_, triangle, a, b)) found.push_back(*hit);
  });
  std::sort(found.begin(), found.end(), [](const PatchHit& x, const PatchHit& y) { return x.t < y.t; });
  return found;
}

bool PatchIntersector::separates(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  return hits(a, b).size() % 2 == 1;
}

std::vector<int> PatchIntersector::trianglesNear(const Eigen::AlignedBox3d& box) const {
  std::vector<int> found;
  visit([&box](const Eigen::AlignedBox3d& node) { return node.intersects(box); },
        [&](int triangle) {
          if (boxes_[static_cast<std::size_t>(triangle)].intersects(box)) found.push_back(triangle);
        });
  return found;
}

}  // namespace softbody
