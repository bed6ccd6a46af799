#include <test_support/gtest.h>

#include <cmath>

#include "fixtures/model_files.h"
#include "identification/sagging_beam.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/identification/fit_picture.h"
#include "softbody_sim/identification/shape_fit.h"

namespace softbody {
namespace {

using testing::propertyOf;
using testing::SaggingBeam;

/// A beam that sags, and points on its surface as a scan measures them.
struct ScannedBeam : SaggingBeam {
  explicit ScannedBeam(double noise_m, unsigned seed = 1) {
    random.seed(seed);
    const Points x = observe(clamp);
    problem.observations[0].targets.clear();
    visual.rest_vertices = rest();
    visual.triangles = problem.topology.surface;
    const Triangles& triangles = visual.triangles;
    std::uniform_real_distribution<double> uniform;
    std::normal_distribution<double> normal(0.0, noise_m);
    measured.resize(2000, 3);
    for (Eigen::Index k = 0; k < measured.rows(); ++k) {
      const auto f = static_cast<Eigen::Index>(uniform(random) * static_cast<double>(triangles.rows()));
      double a = uniform(random), b = uniform(random);
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      measured.row(k) = (1.0 - a - b) * x.row(triangles(f, 0)) + a * x.row(triangles(f, 1)) +
                        b * x.row(triangles(f, 2)) +
                        (noise_m > 0.0 ? Eigen::RowVector3d(normal(random), normal(random), normal(random))
                                       : Eigen::RowVector3d(Eigen::RowVector3d::Zero()));
    }
  }
  MeshTopology visual;
  Points measured;
};

TEST(ShapeFit, AnExactScanGivesBackTheModulus) {
  const ScannedBeam beam(0.0);
  const MaterialEstimate estimate = identifyFromShape(beam.problem, beam.visual, beam.measured);
  EXPECT_NEAR(estimate.material.youngs_modulus_pa, 4e4, 40.0) << reportOf(estimate);
}

TEST(ShapeFit, AScanThatIsTurnedAndNoisyGivesItWithinTwoStandardErrors) {
  int inside = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    ScannedBeam beam(0.5e-3, seed);
    const Eigen::Isometry3d off = Eigen::Translation3d(0.004, -0.003, 0.002) *
                                  Eigen::AngleAxisd(0.08, Eigen::Vector3d(1.0, -2.0, 1.0).normalized());
    beam.measured = transformed(beam.measured, off);
    const MaterialEstimate estimate = identifyFromShape(beam.problem, beam.visual, beam.measured);
    const EstimatedProperty& modulus = propertyOf(estimate, "youngs_modulus_pa");
    EXPECT_TRUE(modulus.observable);
    EXPECT_NEAR(modulus.value, 4e4, 2e3) << reportOf(estimate);
    inside += std::abs(modulus.value - 4e4) < 2.0 * modulus.statistical ? 1 : 0;
  }
  EXPECT_GE(inside, 5);
}

TEST(ShapeFit, AScanInAnotherUnitOrPlaceIsRefused) {
  const ScannedBeam beam(0.0);
  const auto complaintOf = [&beam](const Points& points) {
    return complaint([&] { identifyFromShape(beam.problem, beam.visual, points); });
  };
  EXPECT_TRUE(says(complaintOf(1e3 * beam.measured), "check the unit"));
  const Points away = beam.measured.rowwise() + Eigen::RowVector3d(1.0, 0.0, 0.0);
  EXPECT_TRUE(says(complaintOf(away), "away from the object"));
  EXPECT_TRUE(says(complaintOf(beam.measured.topRows(10)), "10 points"));
}

TEST(FitPicture, ShowsBodyAndResiduals) {
  ScannedBeam beam(0.5e-3);
  std::vector<Target> targets;
  const MaterialEstimate estimate = identifyFromShape(
      beam.problem, beam.visual, beam.measured, [](double) {}, &targets);
  // The outer half is measured 5 mm deeper: the simulated surface is too high there.
  for (Target& target : targets)
    if (positionOf(target.place, beam.rest(), beam.problem.topology.tets).x() > 0.06)
      target.position -= 0.005 * target.normal;
  beam.problem.observations[0].targets = targets;
  const cv::Mat3b picture = drawFit(beam.problem, estimate);
  EXPECT_EQ(picture.cols, 2 * 560);
  int red = 0, blue = 0;
  for (const cv::Vec3b& pixel : cv::Mat3b(picture.colRange(0, 560))) {
    red += pixel[2] - pixel[0] > 60 ? 1 : 0;
    blue += pixel[0] - pixel[2] > 60 ? 1 : 0;
  }
  EXPECT_GT(red, 5000);
  EXPECT_LT(blue, red / 20);
}

}  // namespace
}  // namespace softbody
