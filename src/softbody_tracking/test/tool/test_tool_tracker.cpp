#include <test_support/gtest.h>

#include <Eigen/Cholesky>

#include "fixtures/tool_scene.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "tool/pose_motion.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33'333'333;
constexpr double kDegree = M_PI / 180.0;

ToolDescription oneMarker(double size_m = 0.05) {
  return {"DICT_4X4_50", {toolMarker(7, size_m)}, Points(0, 3), {}};
}

/// Two faces of a handle, 50 mm apart and turned against each other.
ToolDescription twoMarkers() {
  ToolDescription tool = oneMarker(0.04);
  tool.markers.push_back(toolMarker(
      12, 0.04, Eigen::Translation3d(0.07, 0.0, -0.01) * Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY())));
  return tool;
}

struct PoseError {
  double position_m, rotation_rad, mahalanobis_squared;
};

PoseError errorOf(const ToolObservation& observation, const Eigen::Isometry3d& truth) {
  const Eigen::Matrix<double, 6, 1> e = poseDifference(truth, observation.T_camera_tool);
  return {e.head<3>().norm(), e.tail<3>().norm(), e.dot(observation.covariance.ldlt().solve(e))};
}

struct Tally {
  int frames = 0, answers = 0, flips = 0;
  double position_m = 0.0, rotation_rad = 0.0, mahalanobis_squared = 0.0;
};

/// Single frames, each without a past, seen at an angle from the front.
Tally singleFrames(const ToolDescription& tool, double slant_deg, const ToolTrackerConfig& config,
                   const ToolSceneNoise& noise = {}, int frames = 12) {
  Tally tally;
  std::mt19937 random(static_cast<unsigned>(17 + slant_deg));
  for (int i = 0; i < frames; ++i) {
    const Eigen::Isometry3d truth = slanted(slant_deg * kDegree, &random);
    ToolTracker tracker(tool, config);
    const auto answer = tracker.track(renderTool(tool, truth, 0, static_cast<unsigned>(i), noise), nullptr);
    ++tally.frames;
    if (!answer) continue;
    const PoseError error = errorOf(*answer, truth);
    ++tally.answers;
    if (error.rotation_rad > 10.0 * kDegree) ++tally.flips;
    tally.position_m = std::max(tally.position_m, error.position_m);
    tally.rotation_rad = std::max(tally.rotation_rad, error.rotation_rad);
    tally.mahalanobis_squared += error.mahalanobis_squared / frames;
  }
  return tally;
}

TEST(ToolTracker, WithDepthNoPoseFlipsFromFrontalToSteep) {
  for (const double slant : {0.0, 5.0, 15.0, 40.0, 60.0}) {
    SCOPED_TRACE(slant);
    const Tally tally = singleFrames(oneMarker(), slant, {});
    EXPECT_EQ(tally.answers, tally.frames);
    EXPECT_EQ(tally.flips, 0);
    EXPECT_LT(tally.position_m, 0.0015);
    EXPECT_LT(tally.rotation_rad, 2.5 * kDegree);
    // Six degrees of freedom. Less is to be expected: the covariance allows for errors that depths share.
    EXPECT_LT(tally.mahalanobis_squared, 6.0);
  }
}

TEST(ToolTracker, WithoutDepthAnAmbiguousPoseIsWithheldRatherThanFlipped) {
  ToolTrackerConfig config;
  config.use_depth = false;
  int answers = 0, frames = 0;
  for (const double slant : {0.0, 5.0, 10.0, 20.0, 45.0}) {
    SCOPED_TRACE(slant);
    const Tally tally = singleFrames(oneMarker(0.025), slant, config);
    EXPECT_EQ(tally.flips, 0);
    answers += tally.answers;
    frames += tally.frames;
  }
  EXPECT_GT(answers, frames / 4);
}

TEST(ToolTracker, BlurAndNoiseWidenTheErrorButDoNotFlip) {
  const Tally tally = singleFrames(oneMarker(), 35.0, {}, {6.0, 2.0, 0.01});
  EXPECT_GT(tally.answers, tally.frames * 9 / 10);
  EXPECT_EQ(tally.flips, 0);
  EXPECT_LT(tally.position_m, 0.003);
}

TEST(ToolTracker, TwoMarkersAreOneMeasurement) {
  const ToolDescription tool = twoMarkers();
  std::mt19937 random(3);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Isometry3d truth = slanted(0.4, &random);
    const RgbdFrame frame = renderTool(tool, truth, 0, static_cast<unsigned>(i));
    ToolDescription first = tool;
    first.markers.pop_back();
    const auto both = ToolTracker(tool).track(frame, nullptr), one = ToolTracker(first).track(frame, nullptr);
    ASSERT_TRUE(both && one);
    EXPECT_EQ(one->markers, 1);
    if (both->markers < 2) continue;  // the second one is seen from the side
    EXPECT_LT(both->covariance.trace(), one->covariance.trace());
    EXPECT_LT(errorOf(*both, truth).position_m, 0.001);
  }
}

TEST(ToolTracker, AMarkerThatDoesNotBelongIsLeftOut) {
  const ToolDescription tool = twoMarkers();
  ToolDescription bent = tool;
  bent.markers[1].T_tool_marker.translation().y() += 0.01;
  std::mt19937 random(5);
  const Eigen::Isometry3d truth = slanted(0.2, &random);
  const auto answer = ToolTracker(tool).track(renderTool(bent, truth, 0, 1), nullptr);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->markers, 1);
}

TEST(ToolTracker, OtherMarkersAreNoTool) {
  ToolDescription other = oneMarker();
  other.markers[0].id = 8;
  ToolTracker tracker(oneMarker());
  EXPECT_FALSE(tracker.track(renderTool(other, facing({0, 0, 0.5}), 0, 1), nullptr));
  EXPECT_TRUE(says(tracker.reason(), "no marker"));
}

/// A tool that moves by 0.3 m/s while it turns by 60 degrees a second.
Eigen::Isometry3d moving(int i) {
  const double t = 1e-9 * static_cast<double>(i * kFrame);
  return facing({-0.12 + 0.3 * t, 0.02, 0.45}) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(60.0 * kDegree * t, Eigen::Vector3d::UnitZ());
}

TEST(ToolTracker, DropoutsAreBridgedWithGrowingCovarianceAndGivenUpInTime) {
  const ToolDescription tool = oneMarker(), nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
  ToolTrackerConfig config;
  config.bridge_time_s = 0.21;  // six frames
  ToolTracker tracker(tool, config);
  const auto track = [&](int i, bool visible) {
    return tracker.track(
        renderTool(visible ? tool : nothing, moving(i), i * kFrame, static_cast<unsigned>(i)), nullptr);
  };
  for (int i = 0; i < 8; ++i) {
    const auto seen = track(i, true);
    ASSERT_TRUE(seen);
    EXPECT_FALSE(seen->bridged);
    EXPECT_TRUE(tracker.reason().empty());
  }
  double spread = 0.0;
  for (int i = 8; i < 14; ++i) {
    const auto guessed = track(i, false);
    ASSERT_TRUE(guessed) << i;
    EXPECT_TRUE(guessed->bridged);
    EXPECT_EQ(guessed->stamp, i * kFrame);
    EXPECT_GT(guessed->covariance.trace(), spread);
    spread = guessed->covariance.trace();
    EXPECT_LT(errorOf(*guessed, moving(i)).position_m, 0.01);
  }
  EXPECT_FALSE(tracker.reason().empty());
  EXPECT_FALSE(track(14, false));
  const auto back = track(15, true);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->bridged);
  EXPECT_LT(errorOf(*back, moving(15)).position_m, 0.0015);
}

/// A camera that an arm swings to and fro, by up to 0.4 m/s and 70 degrees a second.
Eigen::Isometry3d swinging(int i) {
  const double phase = 2.0 * M_PI * 1e-9 * static_cast<double>(i * kFrame) / 1.2;
  return Eigen::Translation3d(0.4 + 0.08 * std::sin(phase), 1.0, 0.0) *
         Eigen::AngleAxisd(0.2 * std::sin(phase + 0.6), Eigen::Vector3d(0.2, 1.0, 0.0).normalized());
}

RgbdFrame swungFrame(const ToolDescription& shown, const Eigen::Isometry3d& T_fixed_tool, int i) {
  RgbdFrame frame =
      renderTool(shown, swinging(i).inverse() * T_fixed_tool, i * kFrame, static_cast<unsigned>(i));
  frame.T_fixed_camera = swinging(i);
  return frame;
}

/// Furthest from where it is while a tool at rest is bridged. @param told where the camera is.
PoseError worstBridged(bool told) {
  const ToolDescription tool = oneMarker(), nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
  const Eigen::Isometry3d resting = swinging(0) * facing({0.0, 0.02, 0.45});
  ToolTracker tracker(tool);
  PoseError worst{0.0, 0.0, 0.0};
  for (int i = 0; i < 17; ++i) {
    RgbdFrame frame = swungFrame(i < 9 ? tool : nothing, resting, i);
    if (!told) frame.T_fixed_camera.setIdentity();
    const auto answer = tracker.track(frame, nullptr);
    EXPECT_TRUE(answer && answer->bridged == (i >= 9)) << i;
    if (!answer || !answer->bridged) continue;
    const PoseError error = errorOf(*answer, swinging(i).inverse() * resting);
    worst.position_m = std::max(worst.position_m, error.position_m);
    worst.mahalanobis_squared = std::max(worst.mahalanobis_squared, error.mahalanobis_squared);
  }
  return worst;
}

TEST(ToolTracker, BeforeACameraThatMovesAToolAtRestIsBridgedAtRest) {
  const PoseError told = worstBridged(true), untold = worstBridged(false);
  EXPECT_LT(told.position_m, 0.004);
  EXPECT_LT(told.mahalanobis_squared, 6.0);
  EXPECT_GT(untold.position_m, 3.0 * told.position_m);
}

TEST(ToolTracker, WhereTheCameraIsNotPlacedTheToolIsSeenButNotBridged) {
  const ToolDescription tool = oneMarker(), nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
  const Eigen::Isometry3d resting = swinging(0) * facing({0.0, 0.02, 0.45});
  ToolTracker tracker(tool);
  const auto track = [&](const ToolDescription& shown, int i, bool placed) {
    RgbdFrame frame = swungFrame(shown, resting, i);
    frame.placed = placed;
    if (!placed) frame.T_fixed_camera.setIdentity();
    return tracker.track(frame, nullptr);
  };
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(track(tool, i, true));
  const auto seen = track(tool, 6, false);
  ASSERT_TRUE(seen && !seen->bridged);
  EXPECT_LT(errorOf(*seen, swinging(6).inverse() * resting).position_m, 0.0015);
  EXPECT_FALSE(track(nothing, 7, false));
  // What a frame without a place showed has not been taken for motion.
  const auto guessed = track(nothing, 8, true);
  ASSERT_TRUE(guessed && guessed->bridged);
  EXPECT_LT(errorOf(*guessed, swinging(8).inverse() * resting).position_m, 0.005);
}

TEST(ToolTracker, AFrameOfAnotherPassStartsAgain) {
  ToolTracker tracker(oneMarker());
  ASSERT_TRUE(tracker.track(renderTool(oneMarker(), moving(5), 5 * kFrame, 1), nullptr));
  const ToolDescription nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
  RgbdFrame empty = renderTool(nothing, moving(1), 6 * kFrame, 1);
  EXPECT_TRUE(tracker.track(empty, nullptr)) << "bridged";
  empty.pass = 1;
  EXPECT_FALSE(tracker.track(empty, nullptr));
}

/// The image is searched with one window a frame, and small markers need a small window.
TEST(ToolTracker, AToolOfAnySizeIsFoundWithinThreeFrames) {
  const Eigen::Isometry3d pose = facing({0.0, 0.0, 0.6}) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  for (const double size_m : {0.015, 0.02, 0.04, 0.1, 0.25}) {
    const ToolDescription tool = oneMarker(size_m);
    ToolTracker tracker(tool);
    int frames = 0;
    std::optional<ToolObservation> found;
    for (; !found && frames < 3; ++frames)
      found = tracker.track(renderTool(tool, pose, frames * kFrame, static_cast<unsigned>(frames)), nullptr);
    EXPECT_TRUE(found) << size_m;
  }
}

TEST(ToolTracker, AToolWithoutMarkersIsRefused) {
  EXPECT_THROW(ToolTracker(ToolDescription{"DICT_4X4_50", {}, Points(0, 3), {}}), std::invalid_argument);
}

TEST(ToolTracker, AToolWithAFrameIsWhereTheFrameIs) {
  ToolDescription knife;
  knife.frame = "knife_link";
  ToolTracker tracker(knife);
  EXPECT_FALSE(tracker.follow(0, std::nullopt));
  EXPECT_TRUE(says(tracker.reason(), "'knife_link'"));
  const Eigen::Isometry3d place = Eigen::Translation3d(0.1, 0.0, 0.5) * Eigen::Isometry3d::Identity();
  const std::optional<ToolObservation> seen = tracker.follow(kFrame, place);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->stamp, kFrame);
  EXPECT_TRUE(seen->cuts);
  EXPECT_FALSE(seen->ambiguous || seen->bridged);
  EXPECT_TRUE(seen->T_camera_tool.isApprox(place));
  EXPECT_TRUE(tracker.reason().empty()) << tracker.reason();
  EXPECT_FALSE(tracker.follow(2 * kFrame, std::nullopt)) << "it is not predicted";
}

}  // namespace
}  // namespace softbody
