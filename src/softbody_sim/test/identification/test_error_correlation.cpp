#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "identification/error_correlation.h"

namespace softbody {
namespace {

/// 40 images of 200 places.
std::vector<ResidualPlace> somePlaces() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<ResidualPlace> once, all;
  for (int k = 0; k < 200; ++k)
    once.push_back({{0.2 * uniform(random), 0.1 * uniform(random), 0.05 * uniform(random)}, -1, 0, 0});
  for (int image = 0; image < 40; ++image)
    for (ResidualPlace place : once) {
      place.image = image;
      all.push_back(place);
    }
  return all;
}

/// The mean factor over trials, where the true one is known from the spread of the fits.
struct Trials {
  template <typename ErrorOf>
  void run(const ErrorOf& errorsOf) {
    const std::vector<ResidualPlace> places = somePlaces();
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd jacobian(count, 2);
    for (Eigen::Index k = 0; k < count; ++k)
      jacobian.row(k) << 1.0, places[static_cast<std::size_t>(k)].rest.x() / 0.1;
    const Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse();
    constexpr int kTrials = 60;
    double squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::mt19937 random(static_cast<unsigned>(trial));
      const Eigen::VectorXd errors = errorsOf(places, &random);
      const Eigen::VectorXd fit = covariance * (jacobian.transpose() * errors);
      squares += fit[1] * fit[1] / kTrials;
      estimated += correlationFactors(places, jacobian, errors - jacobian * fit, covariance)[1] / kTrials;
    }
    truth = squares / covariance(1, 1);
  }
  double truth = 0.0, estimated = 0.0;
};

TEST(ErrorCorrelation, IndependentErrorsHaveNone) {
  Trials trials;
  trials.run([](const std::vector<ResidualPlace>& places, std::mt19937* random) {
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(places.size()),
                                        [&] { return normal(*random); })
        .eval();
  });
  EXPECT_GE(trials.estimated, 1.0);
  EXPECT_LT(trials.estimated, 2.5);
}

/// Each place has one error in all images: it is measured once, not 40 times.
TEST(ErrorCorrelation, ErrorsThatStayCountOnce) {
  Trials trials;
  trials.run([](const std::vector<ResidualPlace>& places, std::mt19937* random) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd errors(static_cast<Eigen::Index>(places.size()));
    for (Eigen::Index k = 0; k < errors.size(); ++k) errors[k] = k < 200 ? normal(*random) : errors[k - 200];
    return errors;
  });
  EXPECT_NEAR(trials.truth, 40.0, 15.0);
  EXPECT_GT(trials.estimated, 0.7 * trials.truth);
  EXPECT_LT(trials.estimated, 2.5 * trials.truth);
}

/// Each image has one error of all its places, along the slope.
TEST(ErrorCorrelation, ErrorsOfAnImageCountOnce) {
  Trials trials;
  trials.run([](const std::vector<ResidualPlace>& places, std::mt19937* random) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd errors(static_cast<Eigen::Index>(places.size()));
    double slope = 0.0;
    for (Eigen::Index k = 0; k < errors.size(); ++k) {
      if (k % 200 == 0) slope = normal(*random);
      errors[k] = slope * (places[static_cast<std::size_t>(k)].rest.x() / 0.1 - 1.0) + normal(*random);
    }
    return errors;
  });
  EXPECT_GT(trials.truth, 20.0);
  EXPECT_GT(trials.estimated, 0.7 * trials.truth);
  EXPECT_LT(trials.estimated, 2.5 * trials.truth);
}

TEST(ErrorCorrelation, PatchesAreEqualInNumberAndTogether) {
  const std::vector<ResidualPlace> places = somePlaces();
  const std::vector<int> patches = patchesOf(places, 3);
  std::vector<int> counts(8, 0);
  for (const int patch : patches) ++counts.at(static_cast<std::size_t>(patch));
  EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), *std::min_element(counts.begin(), counts.end()));
}

}  // namespace
}  // namespace softbody
