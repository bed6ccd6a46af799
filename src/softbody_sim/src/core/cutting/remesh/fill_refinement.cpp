#include "cutting/remesh/fill_refinement.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "cutting/remesh/edit_accuracy.h"
#include "cutting/remesh/edit_kind.h"
#include "cutting/remesh/edit_making.h"
#include "cutting/remesh/edit_shape.h"

namespace softbody {
namespace {

constexpr double kLongest = 1.4;          // of an edge, over the size wanted in its middle
constexpr double kGrowth = 0.3;           // of the wanted size per distance from the border
constexpr double kLeastFlipGain = 1.001;  // of the sine of the least angle, by a flip

class Refinement {
 public:
  Refinement(double distance, CutComplex* complex) : distance_(distance), complex_(*complex) {}

  void run();

 private:
  struct Edge {
    double excess;  ///< length over the wanted one
    int triangle, k;
    std::array<int, 2> ends;
    bool operator<(const Edge& other) const {
      return std::tie(excess, other.triangle, other.k) < std::tie(other.excess, triangle, k);
    }
  };

  void findSizes();
  double sizeInMiddle(int a, int b) const {
    return 0.5 * (sizes_[a] + sizes_[b] + kGrowth * (complex_.at(a) - complex_.at(b)).norm());
  }
  void offer(int t);
  void split(const Edge& edge);
  void flipAround(std::vector<int> made);

  double distance_;
  CutComplex& complex_;
  std::vector<double> sizes_;  ///< per vertex, wanted length of the edges there [m]
  std::priority_queue<Edge> open_;
  ComplexEdit edit_;
};

/// On the curve, the mean length of its edges; elsewhere their mean length on the whole curve.
void Refinement::findSizes() {
  sizes_.assign(complex_.vertices.size(), 0.0);
  std::vector<int> counts(sizes_.size(), 0);
  double sum = 0.0, count = 0.0;
  for (const ComplexTriangle& triangle : complex_.triangles) {
    if (!triangle.used() || triangle.sheet == Sheet::kSkin) continue;
    for (int k = 0; k < 3; ++k) {
      if (triangle.lines[k] != Line::kCurve) continue;
      const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
      const double length = (complex_.at(a) - complex_.at(b)).norm();
      for (const int v : {a, b}) sizes_[v] += length, ++counts[v];
      sum += length, count += 1.0;
    }
  }
  for (std::size_t v = 0; v < sizes_.size(); ++v)
    sizes_[v] = counts[v] > 0 ? sizes_[v] / counts[v] : sum / count;
}

void Refinement::offer(int t) {
  const ComplexTriangle& triangle = complex_.triangles[t];
  for (int k = 0; k < 3; ++k) {
    if (triangle.lines[k] == Line::kCurve) continue;
    const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
    const double excess = (complex_.at(a) - complex_.at(b)).norm() / sizeInMiddle(a, b);
    if (excess > kLongest) open_.push({excess, t, k, {a, b}});
  }
}

void Refinement::run() {
  findSizes();
  for (int t = 0; t < static_cast<int>(complex_.triangles.size()); ++t) {
    if (complex_.triangles[t].used() && complex_.triangles[t].sheet == Sheet::kFill) offer(t);
  }
  while (!open_.empty()) {
    const Edge edge = open_.top();
    open_.pop();
    const ComplexTriangle& triangle = complex_.triangles[edge.triangle];
    if (triangle.used() && triangle.corners[edge.k] == edge.ends[0]) split(edge);
  }
}

void Refinement::split(const Edge& edge) {
  if (!describeSplit(complex_, edge.triangle, edge.k, &edit_)) return;
  sizes_.push_back(sizeInMiddle(edge.ends[0], edge.ends[1]));
  flipAround(makeEdit(edit_, &complex_));
}

/// Lawson's flips: towards a Delaunay triangulation.
void Refinement::flipAround(std::vector<int> made) {
  while (!made.empty()) {
    const int t = made.back();
    made.pop_back();
    bool flipped = false;
    for (int k = 0; k < 3 && !flipped && complex_.triangles[t].used(); ++k) {
      if (!describeFlip(complex_, t, k, &edit_)) continue;
      const double before = kLeastFlipGain * shapeBefore(complex_, edit_, Judged::kAll);
      if (shapeAfter(complex_, edit_, Judged::kAll, before) <= 0.0) continue;
      if (!keepsKind(complex_, edit_) || !staysNear(complex_, edit_, distance_)) continue;
      const std::vector<int> next = makeEdit(edit_, &complex_);
      made.insert(made.end(), next.begin(), next.end());
      flipped = true;
    }
    if (!flipped && complex_.triangles[t].used()) offer(t);
  }
}

}  // namespace

void refineFill(double distance, CutComplex* complex) { Refinement(distance, complex).run(); }

}  // namespace softbody
