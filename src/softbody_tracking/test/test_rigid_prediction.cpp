#include <gtest/gtest.h>

#include "core/rigid_prediction.h"
#include "softbody_common/rigid_fit.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

/// A screw motion: turns about a fixed axis and shifts along it.
Points screwed(const Points& rest, double angle) {
  return transformed(rest, Eigen::Translation3d(0.0, 0.0, 0.02 * angle) *
                               Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                               Eigen::Isometry3d::Identity());
}

TEST(RigidPrediction, GoesOnAsTheBodyMoved) {
  const Points rest = makeBox().volume.rest_vertices;
  RigidPrediction prediction(rest);
  prediction.observe(screwed(rest, 0.1), 1000);
  EXPECT_TRUE(prediction.motionUntil(2000).isApprox(Eigen::Isometry3d::Identity()))
      << "one state is no motion";
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_LT((transformed(screwed(rest, 0.2), prediction.motionUntil(3000)) - screwed(rest, 0.3)).norm(),
            1e-9);
  EXPECT_LT((transformed(screwed(rest, 0.2), prediction.motionUntil(3500)) - screwed(rest, 0.35)).norm(),
            1e-9);
}

TEST(RigidPrediction, SaysNothingAfterAGapOrAJumpBack) {
  const Points rest = makeBox().volume.rest_vertices;
  RigidPrediction prediction(rest);
  prediction.observe(screwed(rest, 0.1), 1000);
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_TRUE(prediction.motionUntil(20000).isApprox(Eigen::Isometry3d::Identity()));
  prediction.observe(screwed(rest, 0.0), 500);
  EXPECT_TRUE(prediction.motionUntil(1000).isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace softbody
