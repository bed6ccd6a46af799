#include "cutting/remesh/complex_improvement.h"

#include "cutting/remesh/edit_accuracy.h"
#include "cutting/remesh/edit_kind.h"
#include "cutting/remesh/edit_making.h"
#include "cutting/remesh/edit_shape.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace softbody {
namespace {

constexpr double kLeastGain = 1.1;                  // of the sine of the least angle, by an edit
constexpr std::array<double, 2> kShares{0.3, 0.6};  // of the way of a slide

class Improvement {
 public:
  Improvement(Sheet first, Judged judged, double goal, double distance, CutComplex* complex)
      : first_(first), judged_(judged), goal_(goal), distance_(distance), complex_(*complex) {}

  void run();

 private:
  using Entry = std::pair<double, int>;  ///< sine of the least angle, triangle

  void offer(int t);
  bool improve(int t);
  void consider();
  void considerFlips(int t);
  void considerCollapses(int t);
  void considerMoves(int t);
  Eigen::Vector3d middleAround(int vertex) const;
  bool done() const { return best_shape_ >= goal_; }

  Sheet first_;
  Judged judged_;
  double goal_, distance_;
  CutComplex& complex_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  std::vector<char> is_open_;        ///< per triangle
  std::array<Freedom, 3> freedoms_;  ///< of the corners of the triangle that is edited
  ComplexEdit edit_, best_;
  double best_shape_ = 0.0;
};

void Improvement::offer(int t) {
  const ComplexTriangle& triangle = complex_.triangles[t];
  if (!triangle.used() || triangle.is_fixed || triangle.shape >= goal_) return;
  if (judged_ == Judged::kSkin && triangle.sheet == Sheet::kFill) return;
  if (is_open_.size() < complex_.triangles.size()) is_open_.resize(complex_.triangles.size(), 0);
  if (std::exchange(is_open_[t], 1) == 0) open_.emplace(triangle.shape, t);
}

void Improvement::run() {
  for (int t = 0; t < static_cast<int>(complex_.triangles.size()); ++t) {
    if (complex_.triangles[t].sheet == first_) offer(t);
  }
  std::size_t left = 20 * complex_.triangles.size();  // of edits
  while (!open_.empty() && left > 0) {
    const int t = open_.top().second;
    open_.pop();
    is_open_[t] = 0;
    if (!complex_.triangles[t].used() || !improve(t)) continue;
    --left;
    for (const int made : makeEdit(best_, &complex_)) {
      for (const int v : complex_.triangles[made].corners) {
        for (const int near : complex_.vertices[v].triangles) offer(near);
      }
    }
  }
}

/// Finds the best edit of a triangle, or the first one that is good enough.
bool Improvement::improve(int t) {
  best_shape_ = 0.0;
  for (int k = 0; k < 3; ++k) freedoms_[k] = freedomOf(complex_, complex_.triangles[t].corners[k]);
  considerFlips(t);
  considerCollapses(t);
  considerMoves(t);
  return best_shape_ > 0.0;
}

void Improvement::consider() {
  const double limit = std::max(kLeastGain * shapeBefore(complex_, edit_, judged_), best_shape_);
  const double shape = shapeAfter(complex_, edit_, judged_, limit);
  if (shape <= 0.0 || !keepsKind(complex_, edit_) || !staysNear(complex_, edit_, distance_)) return;
  std::swap(best_, edit_);
  best_shape_ = shape;
}

void Improvement::considerFlips(int t) {
  for (int k = 0; k < 3 && !done(); ++k) {
    if (describeFlip(complex_, t, k, &edit_)) consider();
  }
}

void Improvement::considerCollapses(int t) {
  const std::array<int, 3> corners = complex_.triangles[t].corners;
  for (int k = 0; k < 3 && !done(); ++k) {
    for (const int other : {(k + 1) % 3, (k + 2) % 3}) {
      if (!done() && describeCollapse(complex_, corners[k], freedoms_[k], corners[other], &edit_)) consider();
    }
  }
  for (int k = 0; k < 3 && !done(); ++k) {
    if (freedoms_[(k + 2) % 3].kind != Freedom::Kind::kAnywhere) continue;
    if (describeCutOff(complex_, t, k, &edit_)) consider();
  }
}

void Improvement::considerMoves(int t) {
  const std::array<int, 3> corners = complex_.triangles[t].corners;
  for (int k = 0; k < 3 && !done(); ++k) {
    const int v = corners[k];
    if (freedoms_[k].kind == Freedom::Kind::kAnywhere) {
      const Eigen::Vector3d way = middleAround(v) - complex_.at(v);
      for (const double share : {1.0, 0.5}) {
        if (!done() && describeMove(complex_, v, complex_.at(v) + share * way, &edit_)) consider();
      }
    } else if (freedoms_[k].kind == Freedom::Kind::kAlongLine) {
      for (const int end : freedoms_[k].ends) {
        for (const double share : kShares) {
          if (!done() && describeSlide(complex_, v, freedoms_[k], end, share, &edit_)) consider();
        }
      }
    }
  }
}

Eigen::Vector3d Improvement::middleAround(int vertex) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int t : complex_.vertices[vertex].triangles) {
    for (const int v : complex_.triangles[t].corners) {
      if (v != vertex) sum += complex_.at(v);
    }
  }
  return sum / (2.0 * static_cast<double>(complex_.vertices[vertex].triangles.size()));
}

}  // namespace

void improveSkin(double goal, double distance, CutComplex* complex) {
  Improvement(Sheet::kSkin, Judged::kSkin, goal, distance, complex).run();
}

void improveFill(double goal, double distance, CutComplex* complex) {
  Improvement(Sheet::kFill, Judged::kAll, goal, distance, complex).run();
}

}  // namespace softbody
