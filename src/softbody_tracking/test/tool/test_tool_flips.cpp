#include <gtest/gtest.h>

#include "fixtures/jittered_tool.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "tool/corner_noise.h"
#include "tool/pose_motion.h"

namespace softbody {
namespace {

constexpr Nanoseconds kPeriod = 33'333'333;
constexpr double kOneDegree = M_PI / 180.0;

/// A knife, 138 mm long.
ToolDescription knife(double size_m, int markers = 1) {
  Points blade(4, 3);
  blade << 0, -.10, -.02, 0, -.145, -.02, 0, -.145, -.15, 0, -.10, -.15;
  ToolDescription tool{"DICT_4X4_50", {toolMarker(7, size_m)}, blade, {}};
  const Eigen::Isometry3d beside =
      Eigen::Translation3d(1.6 * size_m, 0.0, -0.01) * Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY());
  if (markers > 1) tool.markers.push_back(toolMarker(12, size_m, beside));
  return tool;
}

/// Tilted against the line of sight; it wanders by 10 mm to and fro while it turns about its normal.
Eigen::Isometry3d held(double distance_m, double tilt_rad, int i) {
  const double t = 1e-9 * static_cast<double>(i * kPeriod);
  const Eigen::Vector3d at(0.01 * std::sin(2.0 * t) - 0.01, 0.01 * std::cos(1.7 * t), distance_m);
  return Eigen::Translation3d(at) * Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), at) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(0.8, 0.6, 0.0)) *
         Eigen::AngleAxisd(0.1 * t, Eigen::Vector3d::UnitZ());
}

struct FlipTally {
  int frames = 0, seen = 0, cuts = 0, flips = 0;
  double squared_error = 0.0, claimed = 0.0;  ///< of the rotation, sums over the frames with the tool in view
};

FlipTally watch(const ToolDescription& tool, double distance_m, double tilt_rad, const Jitter& jitter,
                unsigned seed, int frames) {
  FlipTally tally;
  std::mt19937 random(seed);
  ToolTracker tracker(tool);
  for (int i = 0; i < frames; ++i, ++tally.frames) {
    const Eigen::Isometry3d truth = held(distance_m, tilt_rad, i);
    const auto answer = tracker.track(jitteredFrame(tool, truth, i * kPeriod, jitter, &random), nullptr);
    if (!answer || answer->bridged) continue;
    const double error = poseDifference(truth, answer->T_camera_tool).tail<3>().norm();
    ++tally.seen;
    tally.cuts += answer->cuts ? 1 : 0;
    tally.flips += answer->cuts && error > 15.0 * kOneDegree ? 1 : 0;
    tally.squared_error += error * error;
    tally.claimed += answer->covariance.bottomRightCorner<3, 3>().trace();
  }
  return tally;
}

TEST(ToolFlips, ASmallMarkerThatFacesTheCameraNeverCutsInAWrongPose) {
  for (const bool depth : {true, false}) {
    SCOPED_TRACE(depth ? "with depth" : "without depth");
    const FlipTally tally = watch(knife(0.02), 0.6, 0.0, {1.0, depth}, 1, 300);
    EXPECT_EQ(tally.flips, 0) << "of " << tally.cuts;
    EXPECT_GT(tally.seen, tally.frames / 4);
    EXPECT_LT(tally.squared_error, 2.0 * tally.claimed) << "the covariance says that the pose is uncertain";
  }
}

TEST(ToolFlips, AnyTiltDistanceAndNoiseGivesNoWrongBlade) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (unsigned seed = 0; seed < 12; ++seed) {
    const double size_m = 0.02 + 0.04 * uniform(random), tilt_rad = 60.0 * kOneDegree * uniform(random),
                 distance_m = 0.3 + 0.4 * uniform(random);
    const Jitter jitter{1.5 * uniform(random), seed % 2 == 0};
    SCOPED_TRACE(::testing::Message() << size_m << " m, tilt " << tilt_rad << ", at " << distance_m << " m, "
                                      << jitter.corner_std_px << " px, depth " << jitter.depth);
    EXPECT_EQ(watch(knife(size_m), distance_m, tilt_rad, jitter, seed, 60).flips, 0);
  }
}

TEST(ToolFlips, GoodPrintsCutFromTheSecondFrame) {
  for (const int markers : {1, 2}) {
    const FlipTally tilted = watch(knife(0.04, markers), 0.4, 0.4, {0.1, true}, 3, 30);
    EXPECT_GE(tilted.cuts, tilted.frames - 2) << markers << " markers";
    EXPECT_EQ(tilted.flips, 0);
  }
}

/// Without the camera's pose, a second pose cannot be compared with the first.
TEST(ToolFlips, FramesWithoutTheCamerasPoseNeitherCutNorConfirm) {
  const ToolDescription tool = knife(0.04, 2);
  std::mt19937 random(3);
  ToolTracker tracker(tool);
  const auto cutsIn = [&](int i, bool placed) {
    RgbdFrame frame = jitteredFrame(tool, held(0.4, 0.4, i), i * kPeriod, {0.1, true}, &random);
    frame.placed = placed;
    const auto answer = tracker.track(frame, nullptr);
    return answer && answer->cuts;
  };
  EXPECT_FALSE(cutsIn(0, false));
  EXPECT_FALSE(cutsIn(1, false));
  EXPECT_FALSE(cutsIn(2, true));
  EXPECT_FALSE(cutsIn(3, false));
  EXPECT_TRUE(cutsIn(4, true));
  EXPECT_TRUE(cutsIn(5, false));
}

TEST(CornerNoise, ApproachesTheSpreadOfTheResidualsAndNeverFallsBelowTheGivenValue) {
  std::mt19937 random(1);
  for (const double true_px : {0.05, 0.15, 1.0}) {
    CornerNoise noise(0.15);
    EXPECT_DOUBLE_EQ(noise.std_px(), 0.15);
    for (int i = 0; i < 200; ++i) {
      std::chi_squared_distribution<double> cost(2.0);
      noise.add(std::pow(true_px / noise.std_px(), 2) * cost(random), 2.0);
      EXPECT_GE(noise.std_px(), 0.15);
    }
    EXPECT_NEAR(noise.std_px(), std::max(0.15, true_px), 0.25 * std::max(0.15, true_px));
    EXPECT_GT(noise.freedom(), 50.0);
  }
}

}  // namespace
}  // namespace softbody
