#include <gtest/gtest.h>

#include <stdexcept>

#include "softbody_sim/interpolation/tiled_weights.h"

namespace softbody {
namespace {

TEST(TiledWeights, MultiplyAsTheMatrixThatTheyAreMadeOf) {
  for (const Eigen::Index rows : {0, 1, 31, 32, 33, 500}) {
    for (const Eigen::Index columns : {1, 4, 132}) {
      const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(rows, columns);
      TiledWeights weights(columns);
      for (Eigen::Index r = 0; r < rows; ++r) weights.append(matrix.row(r));
      ASSERT_EQ(weights.rows(), rows);
      const TiledWeights::Values values = TiledWeights::Values::Random(columns, 4);
      TiledWeights::Products products;
      weights.multiply(values, &products);
      ASSERT_GE(products.rows(), rows);
      const Eigen::MatrixXd expected = matrix * values.cast<double>();
      if (rows == 0) continue;
      EXPECT_LT((products.topRows(rows).cast<double>() - expected).cwiseAbs().maxCoeff(),
                2e-7 * static_cast<double>(columns));
    }
  }
}

TEST(TiledWeights, AreSinglePrecise) {
  TiledWeights weights(1);
  weights.append(Eigen::RowVectorXd::Constant(1, 1.0 / 3.0));
  TiledWeights::Products products;
  weights.multiply(TiledWeights::Values::Constant(1, 4, 1.0f), &products);
  EXPECT_EQ(products(0, 3), 1.0f / 3.0f);
}

TEST(TiledWeights, RefuseValuesThatDoNotFit) {
  TiledWeights::Products products;
  EXPECT_THROW(TiledWeights(3).multiply(TiledWeights::Values::Zero(2, 4), &products), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
