#include <gtest/gtest.h>

#include <map>
#include <random>

#include "elasticity/corotated_elasticity.h"
#include "elasticity/elastic_blocks.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

using testing::randomPoints;

const Lame kSoft{8.0e3, 5.0e3}, kStiff{4.0e5, 9.0e6};

/// A body whose tets have one of two materials at random.
class TwoMaterials : public ::testing::TestWithParam<double> {
 protected:
  TwoMaterials() {
    materials_.kinds = {{kSoft, GetParam()}, {kStiff, {GetParam(), GetParam() > 0.0 ? 1.0 : 0.0}}};
    for (Eigen::Index t = 0; t < body_.tets.rows(); ++t)
      materials_.of_tets.push_back(static_cast<int>(random_() % 2));
  }

  /// Energy and forces of the tets of one kind, as a body of its own.
  double addPart(int kind, Points* gradient) const {
    std::map<int, int> numbers;
    Tets tets(body_.tets.rows(), 4);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < body_.tets.rows(); ++t) {
      if (materials_.kindOf(t) != kind) continue;
      for (int k = 0; k < 4; ++k)
        tets(count, k) = numbers.emplace(body_.tets(t, k), static_cast<int>(numbers.size())).first->second;
      ++count;
    }
    tets.conservativeResize(count, 4);
    Points rest(numbers.size(), 3), x = rest, forces = Points::Zero(rest.rows(), 3);
    for (const auto& [vertex, number] : numbers) {
      rest.row(number) = body_.rest_vertices.row(vertex);
      x.row(number) = x_.row(vertex);
    }
    const ElasticMaterial& material = materials_.kinds[static_cast<std::size_t>(kind)];
    const double energy =
        CorotatedElasticity(rest, tets, {material.lame, material.smoothing}).addTo(x, &forces);
    for (const auto& [vertex, number] : numbers) gradient->row(vertex) += forces.row(number);
    return energy;
  }

  template <typename T>
  void expectInBlocks(double energy, const Points& gradient, double rounding) const {
    const CorotatedElasticity elasticity(body_.rest_vertices, body_.tets, materials_);
    Rows<T> x = Rows<T>::Zero(paddedRows(x_.rows()), 4), sum = x;
    x.topLeftCorner(x_.rows(), 3) = x_.cast<T>();
    ElasticBlocks<T> blocks(body_.rest_vertices, elasticity, Simd::kAuto);
    EXPECT_NEAR(blocks.addTo(x, &sum), energy, rounding * energy);
    const Points found = sum.topLeftCorner(x_.rows(), 3).template cast<double>();
    EXPECT_LT((found - gradient).norm(), rounding * gradient.norm());
  }

  std::mt19937 random_{17};
  const TetTopology body_ = testing::boxTopology({5, 3, 2}, {0.1, 0.06, 0.05});
  const Points x_ = body_.rest_vertices + randomPoints(body_.rest_vertices.rows(), 2e-3, &random_);
  ElasticMaterials materials_{kSoft};
};

/// No strain is averaged over tets of different materials.
TEST_P(TwoMaterials, TheEnergyIsThatOfTheTwoPartsApart) {
  Points expected = Points::Zero(x_.rows(), 3), gradient = expected, fem_gradient = expected;
  const double energy = addPart(0, &expected) + addPart(1, &expected);
  const CorotatedElasticity elasticity(body_.rest_vertices, body_.tets, materials_);
  EXPECT_NEAR(elasticity.addTo(x_, &gradient), energy, 1e-12 * energy);
  EXPECT_LT((gradient - expected).norm(), 1e-12 * expected.norm());
  const FemElasticity fem(body_, Elasticity::kCorotated, materials_);
  EXPECT_NEAR(fem.addTo(x_, &fem_gradient), energy, 1e-9 * energy);
  EXPECT_LT((fem_gradient - expected).norm(), 1e-9 * expected.norm());
  expectInBlocks<double>(energy, expected, 1e-12);
  expectInBlocks<float>(energy, expected, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Smoothings, TwoMaterials, ::testing::Values(0.0, 0.7));

}  // namespace
}  // namespace softbody
