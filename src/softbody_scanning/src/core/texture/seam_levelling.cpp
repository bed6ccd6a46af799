#include "texture/seam_levelling.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "texture/pixel_color.h"

namespace softbody::scanning {
namespace {

constexpr double kSmooth =
    0.1;  // weight of a difference inside of a chart against one at a seam (the paper's)
constexpr double kStay = 1e-4;  // of the correction itself: the sum stays about zero

/// Sums of weighted differences.
struct Differences {
  cv::Vec3d sum;
  double weight = 0.0;
};

using SeamSums = std::map<std::tuple<int, int, int>, Differences>;  // vertex, first, second chart

/// The seam from one vertex to another, seen by the two charts' frames.
struct SeamEdge {
  int from, to, first, second;
};

/// Compares the two charts along the edge. Each place counts for the nearer vertex more.
void compareAlong(const SeamEdge& edge, const TriangleMesh& mesh, const Layout& layout,
                  const std::vector<KeyFrame>& frames, const std::vector<cv::Vec3f>& gains, SeamSums* sums) {
  const auto frameOf = [&](int chart) {
    return static_cast<std::size_t>(layout.charts[static_cast<std::size_t>(chart)].frame);
  };
  const std::size_t one = frameOf(edge.first), other = frameOf(edge.second);
  const Eigen::Vector2d a1 = pixelOf(mesh, edge.from, frames[one]), b1 = pixelOf(mesh, edge.to, frames[one]),
                        a2 = pixelOf(mesh, edge.from, frames[other]),
                        b2 = pixelOf(mesh, edge.to, frames[other]);
  const int steps = 2 + static_cast<int>(std::max((b1 - a1).norm(), (b2 - a2).norm()));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Eigen::Vector2d p1 = (1.0 - t) * a1 + t * b1, p2 = (1.0 - t) * a2 + t * b2;
    const cv::Vec3f color1 = colorAt(frames[one].color, p1.x(), p1.y()),
                    color2 = colorAt(frames[other].color, p2.x(), p2.y());
    for (const auto& [vertex, weight] : {std::pair(edge.from, 1.0 - t), std::pair(edge.to, t)}) {
      Differences& differences = (*sums)[{vertex, edge.first, edge.second}];
      for (int k = 0; k < 3; ++k)
        differences.sum[k] += weight * (color1[k] / gains[one][k] - color2[k] / gains[other][k]);
      differences.weight += weight;
    }
  }
}

/// Numbers for the vertices of each chart.
class Unknowns {
 public:
  int at(int chart, int vertex) {
    return numbers_.try_emplace({chart, vertex}, static_cast<int>(numbers_.size())).first->second;
  }
  int count() const { return static_cast<int>(numbers_.size()); }

 private:
  std::map<std::pair<int, int>, int> numbers_;
};

/// Normal equations of weighted differences.
struct Equations {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<std::tuple<int, int, cv::Vec3f>> known;

  void add(int a, int b, double weight) {
    entries.emplace_back(a, a, weight);
    entries.emplace_back(b, b, weight);
    entries.emplace_back(std::max(a, b), std::min(a, b), -weight);
  }

  Eigen::MatrixXd solve(int count) {
    Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(count, 3);
    for (const auto& [a, b, difference] : known) {
      for (int k = 0; k < 3; ++k) {
        right_side(a, k) -= difference[k];
        right_side(b, k) += difference[k];
      }
    }
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, kStay);
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_side);
  }
};

}  // namespace

std::vector<SeamVertex> compareSeams(const TriangleMesh& mesh, const EdgeNeighbors& neighbors,
                                     const Layout& layout, const std::vector<KeyFrame>& frames,
                                     const std::vector<cv::Vec3f>& gains) {
  SeamSums sums;
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int beyond = neighbors[t][k];
      if (beyond < 0) continue;
      const int first = layout.chart_of[t], second = layout.chart_of[static_cast<std::size_t>(beyond)];
      if (first >= second || layout.charts[static_cast<std::size_t>(first)].frame < 0 ||
          layout.charts[static_cast<std::size_t>(second)].frame < 0)
        continue;
      const auto corners = mesh.triangles.row(static_cast<Eigen::Index>(t));
      const auto i = static_cast<Eigen::Index>(k);
      compareAlong({corners[i], corners[(i + 1) % 3], first, second}, mesh, layout, frames, gains, &sums);
    }
  }
  std::vector<SeamVertex> seams;
  for (const auto& [place, differences] : sums) {
    const auto [vertex, first, second] = place;
    seams.push_back({vertex, first, second, differences.sum * (1.0 / differences.weight)});
  }
  return seams;
}

std::vector<CornerColors> levelSeams(const TriangleMesh& mesh, const Layout& layout,
                                     const std::vector<SeamVertex>& seams) {
  std::vector<CornerColors> corrections(layout.chart_of.size());
  Unknowns unknowns;
  Equations equations;
  const auto unknownAt = [&](std::size_t t, int corner) {
    return unknowns.at(layout.chart_of[t], mesh.triangles(static_cast<Eigen::Index>(t), corner % 3));
  };
  const auto isSeen = [&](std::size_t t) {
    return layout.charts[static_cast<std::size_t>(layout.chart_of[t])].frame >= 0;
  };
  for (std::size_t t = 0; t < corrections.size(); ++t) {
    for (int k = 0; isSeen(t) && k < 3; ++k)
      equations.add(unknownAt(t, k), unknownAt(t, k + 1), 0.5 * kSmooth);
  }
  for (const SeamVertex& seam : seams) {
    const int a = unknowns.at(seam.first, seam.vertex), b = unknowns.at(seam.second, seam.vertex);
    equations.add(a, b, 1.0);
    equations.known.emplace_back(a, b, seam.difference);
  }
  if (unknowns.count() == 0) return corrections;
  const Eigen::MatrixXd solution = equations.solve(unknowns.count());
  for (std::size_t t = 0; t < corrections.size(); ++t) {
    for (int k = 0; isSeen(t) && k < 3; ++k) {
      for (int channel = 0; channel < 3; ++channel)
        corrections[t][static_cast<std::size_t>(k)][channel] =
            static_cast<float>(solution(unknownAt(t, k), channel));
    }
  }
  return corrections;
}

}  // namespace softbody::scanning
