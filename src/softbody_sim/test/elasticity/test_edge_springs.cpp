#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "fem/edge_springs.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

/// The six axes of an icosahedron have all directions alike.
EdgeSprings icosahedronSprings(double youngs_modulus_pa) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  EdgeSprings::Edges axes;
  axes << 0.0, 0.0, 1.0, -1.0, golden, golden,  //
      1.0, -1.0, golden, golden, 0.0, 0.0,      //
      golden, golden, 0.0, 0.0, 1.0, -1.0;
  return {axes, youngs_modulus_pa};
}

TEST(EdgeSprings, SmallStrainsObeyHookesLawIfEdgesHaveAllDirectionsAlike) {
  const double youngs_modulus = 5000.0, poissons_ratio = 0.25;
  const double mu = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
  const double lambda = 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio);
  Eigen::Matrix3d strain;
  strain << 3.0, 0.5, -1.0, 0.5, -2.0, 0.7, -1.0, 0.7, 1.0;
  strain *= 1e-7;
  const Eigen::Matrix3d expected = lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * mu * strain;
  const Eigen::Matrix3d stress =
      icosahedronSprings(youngs_modulus).stress(Eigen::Matrix3d::Identity() + strain);
  EXPECT_LT((stress - expected).norm(), 1e-5 * expected.norm());
}

TEST(FemElasticity, RefusesToSmoothTheStrainsOfSprings) {
  const TetTopology box = testing::boxTopology({1, 1, 1}, {0.1, 0.1, 0.1});
  EXPECT_THROW(FemElasticity(box, Elasticity::kSprings, Lame{8000.0, 5000.0}, Smoothing(0.5)),
               std::invalid_argument);
}

}  // namespace
}  // namespace softbody
