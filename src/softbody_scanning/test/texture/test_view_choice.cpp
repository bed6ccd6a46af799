#include "texture/view_choice.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/painted_ball.h"
#include "texture/view_agreement.h"

namespace softbody::scanning {
namespace {

/// Cost of the Potts model: quality that is given away, and seams.
double costOf(const EdgeNeighbors& neighbors, const TriangleViews& views, const std::vector<int>& labels) {
  double cost = 0.0;
  for (std::size_t t = 0; t < views.size(); ++t) {
    float best = 0.0f, taken = 0.0f;
    for (const TriangleView& view : views[t]) {
      best = std::max(best, view.quality);
      if (view.frame == labels[t]) taken = view.quality;
    }
    if (best > 0.0f) cost += 1.0 - taken / best;
    for (const int other : neighbors[t])
      cost += other > static_cast<int>(t) && labels[static_cast<std::size_t>(other)] != labels[t] ? 0.5 : 0.0;
  }
  return cost;
}

TEST(ViewChoice, CostsLessThanTheBestViewOfEachTriangleAndThanOneChange) {
  const TriangleMesh mesh = ballMesh(18, 36);
  const EdgeNeighbors neighbors = edgeNeighbors(mesh.triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> quality(0.5f, 1.0f);
  TriangleViews views(static_cast<std::size_t>(mesh.triangles.rows()));
  std::vector<int> best;
  for (auto& of_triangle : views) {
    for (int f = 0; f < 6; ++f) of_triangle.push_back({f, quality(random), {}});
    best.push_back(std::max_element(of_triangle.begin(), of_triangle.end(), [](const auto& a, const auto& b) {
                     return a.quality < b.quality;
                   })->frame);
  }
  std::vector<int> labels = chooseViews(neighbors, views);
  const double cost = costOf(neighbors, views, labels);
  EXPECT_LT(cost, 0.8 * costOf(neighbors, views, best));
  for (std::size_t t = 0; t < views.size(); t += 7) {
    const int kept = labels[t];
    for (labels[t] = 0; labels[t] < 6; ++labels[t]) EXPECT_GE(costOf(neighbors, views, labels), cost - 1e-4);
    labels[t] = kept;
  }
}

TEST(ViewAgreement, OneColourAmongManyIsLeftOut) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0f, 4.0f);
  TriangleViews views(200);
  for (auto& of_triangle : views) {
    for (int f = 0; f < 8; ++f)
      of_triangle.push_back({f, 1.0f, {100 + noise(random), 120 + noise(random), 60 + noise(random)}});
    of_triangle[3].color = {20, 20, 200};
  }
  const std::size_t before = 8 * views.size();
  removeOutliers(EdgeNeighbors(views.size(), {-1, -1, -1}), &views);
  std::size_t after = 0;
  for (const auto& of_triangle : views) {
    after += of_triangle.size();
    for (const TriangleView& view : of_triangle) EXPECT_NE(view.frame, 3);
  }
  EXPECT_GT(static_cast<double>(after), 0.95 * 7.0 / 8.0 * static_cast<double>(before));
}

TEST(EdgeNeighbors, EachSideOfAClosedMeshHasOne) {
  const TriangleMesh mesh = ballMesh(6, 8);
  const EdgeNeighbors neighbors = edgeNeighbors(mesh.triangles);
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (const int other : neighbors[t]) {
      ASSERT_GE(other, 0);
      const auto& back = neighbors[static_cast<std::size_t>(other)];
      EXPECT_NE(std::find(back.begin(), back.end(), static_cast<int>(t)), back.end());
    }
  }
}

}  // namespace
}  // namespace softbody::scanning
