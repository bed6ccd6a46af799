#include <test_support/gtest.h>

#include "fixtures/tool_scene.h"
#include "softbody_tracking/tool/tool_calibration_check.h"

namespace softbody {
namespace {

constexpr int kFrames = 8;

const ToolDescription& knife() {
  static const ToolDescription kTool{"DICT_4X4_50", {toolMarker(7, 0.06)}, Points(0, 3), {}};
  return kTool;
}

/// A still tool, and what is claimed of it.
ToolCalibrationReport check(const ToolDescription& claimed, double focal_factor = 1.0, bool visible = true) {
  ToolCalibrationCheck check(claimed);
  std::mt19937 random(9);
  const Eigen::Isometry3d pose = slanted(0.6, &random);
  for (int i = 0; i < kFrames; ++i) {
    const ToolDescription nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
    RgbdFrame frame =
        renderTool(visible ? knife() : nothing, pose, i * 33'000'000LL, static_cast<unsigned>(i));
    frame.camera.fx *= focal_factor;
    frame.camera.fy *= focal_factor;
    check.add(frame);
  }
  return check.report();
}

TEST(ToolCalibrationCheck, FindsNothingWrongWithARightToolAndCamera) {
  const ToolCalibrationReport report = check(knife());
  EXPECT_EQ(report.seen, kFrames);
  EXPECT_TRUE(report.faults.empty()) << report.faults.front();
  EXPECT_NEAR(report.depth_ratio, 1.0, 0.01);
  EXPECT_LT(report.noise_m, 0.001);
}

TEST(ToolCalibrationCheck, NamesTheSizeThatDepthAsksFor) {
  ToolDescription wrong = knife();
  wrong.markers[0].size_m = 0.048;
  const ToolCalibrationReport report = check(wrong);
  EXPECT_NEAR(report.depth_ratio, 1.25, 0.01);
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_TRUE(says(report.faults[0], "not 48.0"));
}

TEST(ToolCalibrationCheck, NamesTheFocalLengthThatDepthAsksFor) {
  const ToolCalibrationReport report = check(knife(), 0.9);
  EXPECT_NEAR(report.depth_ratio, 1.0 / 0.9, 0.02);
  EXPECT_FALSE(report.faults.empty());
}

TEST(ToolCalibrationCheck, SaysThatTheToolIsNotSeen) {
  const ToolCalibrationReport report = check(knife(), 1.0, false);
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_TRUE(says(report.faults[0], "0 of 8"));
}

}  // namespace
}  // namespace softbody
