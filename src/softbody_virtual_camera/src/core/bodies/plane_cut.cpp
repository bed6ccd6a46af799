#include "bodies/plane_cut.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "bodies/mesh_builder.h"
#include "bodies/polygon.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kLeastDistance = 1e-6;  // [m]

class Cutter {
 public:
  Cutter(const MeshTopology& before, const PlaneCut& cut)
      : before_(before),
        cut_(cut),
        places_(transformed(cut.T_rest_cut.inverse(), before.rest_vertices)),
        builder_(before) {
    for (Eigen::Index i = 0; i < places_.rows(); ++i) {
      if (std::abs(places_(i, 0)) < kLeastDistance) {
        throw std::invalid_argument(fmt::format("the cut passes through vertex {}", i));
      }
      beyond_.push_back(places_(i, 0) > 0.0);
    }
    for (int f = 0; f < static_cast<int>(before.triangles.rows()); ++f) split(f);
    if (next_.empty()) throw std::invalid_argument("the cut misses the body");
    closeAlongFront();
    fill();
  }

  CutMesh result() const { return {builder_.topology(), builder_.triangleParents(), beyond_}; }

 private:
  bool isBeyond(const PartCorner& corner) const { return beyond_[static_cast<std::size_t>(corner.vertex)]; }

  int addVertex(const Eigen::RowVector3d& place, bool beyond) {
    beyond_.push_back(beyond);
    return builder_.addVertex(place);
  }

  /// Intersection of an edge with the plane, as a share of the way from a to b.
  double shareOf(int a, int b) const { return places_(a, 0) / (places_(a, 0) - places_(b, 0)); }

  /// Height of an edge's crossing above the front.
  double heightAt(const PartCorner& a, const PartCorner& b) const {
    return places_(a.vertex, 2) + shareOf(a.vertex, b.vertex) * (places_(b.vertex, 2) - places_(a.vertex, 2));
  }

  bool isCut(const PartCorner& a, const PartCorner& b) const {
    const double height = heightAt(a, b);
    if (!cut_.through && std::abs(height) < kLeastDistance) {
      throw std::invalid_argument(fmt::format(
          "the front of the cut passes through the edge between vertices {} and {}", a.vertex, b.vertex));
    }
    return cut_.through || height > 0.0;
  }

  /// The vertex of the near side at an edge's crossing. The vertex beyond is the next one.
  int crossingVertex(int a, int b) {
    const auto [entry, is_new] = crossings_.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      const Eigen::RowVector3d from = builder_.place(std::min(a, b)), to = builder_.place(std::max(a, b));
      const Eigen::RowVector3d place = from + shareOf(std::min(a, b), std::max(a, b)) * (to - from);
      entry->second = addVertex(place, false);
      addVertex(place, true);
    }
    return entry->second;
  }

  /// The crossing between a and b, on a's side.
  PartCorner crossing(const PartCorner& a, const PartCorner& b) {
    const double share = shareOf(a.vertex, b.vertex);
    return {crossingVertex(a.vertex, b.vertex) + (isBeyond(a) ? 1 : 0),
            (1.0 - share) * a.weights + share * b.weights};
  }

  /// Splits a triangle along the cut.
  void split(int f) {
    PartCorner corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = {before_.triangles(f, k), Eigen::RowVector3d::Unit(k)};
    for (int k = 0; k < 3; ++k) {
      const PartCorner &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
      if (isBeyond(b) != isBeyond(c) || isBeyond(a) == isBeyond(b)) continue;  // a is alone on its side
      const bool first = isCut(a, b), last = isCut(c, a);
      if (first && last) return splitThrough(f, a, b, c);
      if (first) return splitInPart(f, a, b, c);
      if (last) return splitInPart(f, c, a, b);
    }
    builder_.addTriangle(corners[0], corners[1], corners[2], f);
  }

  void splitThrough(int f, const PartCorner& a, const PartCorner& b, const PartCorner& c) {
    const PartCorner ab = crossing(a, b), ac = crossing(a, c), ba = crossing(b, a), ca = crossing(c, a);
    builder_.addTriangle(a, ab, ac, f);
    builder_.addTriangle(ba, b, c, f);
    builder_.addTriangle(ba, c, ca, f);
    isBeyond(a) ? addSegment(ba.vertex, ca.vertex) : addSegment(ac.vertex, ab.vertex);
  }

  /// The cut enters between a and b, and ends at its front inside the triangle.
  void splitInPart(int f, const PartCorner& a, const PartCorner& b, const PartCorner& c) {
    const PartCorner own = crossing(a, b), other = crossing(b, a), tip = tipOf(a, b, c);
    builder_.addTriangle(a, own, tip, f);
    builder_.addTriangle(other, b, tip, f);
    builder_.addTriangle(b, c, tip, f);
    builder_.addTriangle(c, a, tip, f);
    isBeyond(a) ? addSegment(other.vertex, tip.vertex) : addSegment(tip.vertex, own.vertex);
    tips_.insert(tip.vertex);
  }

  /// The vertex at which the front leaves the body through a triangle.
  PartCorner tipOf(const PartCorner& a, const PartCorner& b, const PartCorner& c) {
    const PartCorner& opposite = isBeyond(c) == isBeyond(a) ? b : a;
    const double above = heightAt(a, b), share = above / (above - heightAt(c, opposite));
    const double in = shareOf(a.vertex, b.vertex), out = shareOf(c.vertex, opposite.vertex);
    const Eigen::RowVector3d weights = (1.0 - share) * ((1.0 - in) * a.weights + in * b.weights) +
                                       share * ((1.0 - out) * c.weights + out * opposite.weights);
    Eigen::RowVector3d place = Eigen::RowVector3d::Zero();
    for (const PartCorner& corner : {a, b, c})
      place += weights.dot(corner.weights) * builder_.place(corner.vertex);
    return {addVertex(place, false), weights};
  }

  /// A segment of the section's outline, with vertices of the near side. The section is to its left, seen
  /// from beyond.
  void addSegment(int from, int to) { next_[from] = to; }

  Eigen::Vector2d onPlane(int vertex) const {
    return (cut_.T_rest_cut.inverse() * builder_.place(vertex).transpose()).tail<2>();
  }

  /// The front is the lower side of the section, from every second tip to the next tip.
  void closeAlongFront() {
    std::vector<int> tips(tips_.begin(), tips_.end());
    std::sort(tips.begin(), tips.end(), [&](int a, int b) { return onPlane(a).x() < onPlane(b).x(); });
    for (std::size_t i = 0; i + 1 < tips.size(); i += 2) addSegment(tips[i], tips[i + 1]);
  }

  void fill() {
    while (!next_.empty()) {
      const std::vector<int> outline = takeOutline();
      std::vector<Eigen::Vector2d> polygon;
      polygon.reserve(outline.size());
      for (const int vertex : outline) polygon.push_back(onPlane(vertex));
      for (const auto& [a, b, c] : triangulatePolygon(polygon)) fill(outline[a], outline[b], outline[c]);
    }
  }

  std::vector<int> takeOutline() {
    std::vector<int> outline = {next_.begin()->first};
    for (auto segment = next_.begin(); segment != next_.end(); segment = next_.find(outline.back())) {
      const int to = segment->second;
      next_.erase(segment);
      if (to == outline.front()) return outline;
      outline.push_back(to);
    }
    throw std::invalid_argument("the body is not closed at the cut");
  }

  /// A triangle of the near face, and the same triangle of the face beyond.
  void fill(int a, int b, int c) {
    const auto beyond = [&](int vertex) { return PartCorner{vertex + (tips_.count(vertex) == 0 ? 1 : 0)}; };
    builder_.addTriangle({a}, {b}, {c}, -1);
    builder_.addTriangle(beyond(a), beyond(c), beyond(b), -1);
  }

  const MeshTopology& before_;
  const PlaneCut& cut_;
  Points places_;  ///< of the old vertices, in the cut's frame
  MeshBuilder builder_;
  std::vector<bool> beyond_;
  std::map<std::pair<int, int>, int> crossings_;  ///< by edge
  std::map<int, int> next_;                       ///< segments of the section's outline
  std::set<int> tips_;  ///< points where the front leaves the body; shared by both sides
};

}  // namespace

CutMesh cutByPlane(const MeshTopology& before, const PlaneCut& cut) { return Cutter(before, cut).result(); }

PlaneCut clearOfVertices(const Points& rest, const PlaneCut& cut, double reach) {
  const Eigen::VectorXd places = transformed(cut.T_rest_cut.inverse(), rest).col(0);
  std::vector<double> within = {-reach, reach};
  std::copy_if(places.begin(), places.end(), std::back_inserter(within),
               [reach](double place) { return std::abs(place) < reach; });
  std::sort(within.begin(), within.end());
  double middle = 0.0, widest = 0.0;
  for (std::size_t i = 1; i < within.size(); ++i) {
    const double gap = within[i] - within[i - 1];
    if (gap > widest) std::tie(middle, widest) = std::pair(0.5 * (within[i] + within[i - 1]), gap);
  }
  return {cut.T_rest_cut * Eigen::Translation3d(middle, 0.0, 0.0), cut.through};
}

}  // namespace softbody::virtual_camera
