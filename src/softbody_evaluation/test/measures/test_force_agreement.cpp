#include <gtest/gtest.h>

#include "softbody_evaluation/measures/force_agreement.h"

namespace softbody::evaluation {
namespace {

ForcePatch patchAt(double x, double force, double deviation) {
  ForcePatch patch;
  patch.place << x, 0.0, 0.0;
  patch.force << 0.0, 0.0, force;
  patch.covariance = deviation * deviation * Eigen::Matrix3d::Identity();
  return patch;
}

TEST(ForceAgreement, GathersWhatIsNearATrueForce) {
  ForceAgreement agreement;
  EXPECT_FALSE(agreement.report());
  agreement.add({patchAt(0.0, -2.0, 0.0), patchAt(0.2, 1.0, 0.0)},
                {patchAt(-0.01, -1.0, 0.1), patchAt(0.03, -0.9, 0.1), patchAt(0.21, 1.4, 0.1)});
  const ForceReport report = agreement.report().value();
  EXPECT_EQ(report.frames, 1u);
  EXPECT_NEAR(report.force_n.mean, 0.1, 1e-6);
  EXPECT_EQ(report.right, 1.0);
  EXPECT_NEAR(report.place_m.mean, (-0.01 * 1.0 + 0.03 * 0.9) / 1.9, 1e-6);
  EXPECT_EQ(report.within, 0.5) << "the smaller force is off by four deviations";
}

TEST(ForceAgreement, AForceThatIsNotFoundIsWrong) {
  ForceAgreement agreement;
  agreement.add({patchAt(0.0, -2.0, 0.0)}, {});
  agreement.add({patchAt(0.0, -0.05, 0.0)}, {});  // too small to count
  const ForceReport report = agreement.report().value();
  EXPECT_EQ(report.frames, 1u);
  EXPECT_EQ(report.force_n.mean, 2.0);
  EXPECT_EQ(report.right, 0.0);
  EXPECT_EQ(report.place_m.count, 0u);
  EXPECT_EQ(report.within, 0.0);
}

}  // namespace
}  // namespace softbody::evaluation
