#include <gtest/gtest.h>

#include "fixtures/tool_scene.h"
#include "softbody_tracking/tool/marker_absence.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

ToolDescription toolOf(int id, double size_m = 0.06, const std::string& dictionary = "DICT_4X4_50") {
  return {dictionary, {toolMarker(id, size_m)}, Points(0, 3), {}};
}

/// A tool's markers seen nearly from the front, before a wall of any brightness.
cv::Mat1b view(const ToolDescription& shown, unsigned seed, cv::Mat1b* on_marker = nullptr) {
  std::mt19937 random(seed);
  const Eigen::Isometry3d T = slanted(0.1, &random);
  const RgbdFrame frame = renderTool(shown, T, 0, seed);
  cv::Mat1b gray;
  cv::cvtColor(frame.color, gray, cv::COLOR_BGR2GRAY);
  if (on_marker == nullptr) return gray;
  const Eigen::Matrix<double, 3, 4> corners = T * markerCorners(shown.markers[0]);
  std::vector<cv::Point> outline;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d p = toolCamera().project(corners.col(k));
    outline.emplace_back(cvRound(p.x()), cvRound(p.y()));
  }
  *on_marker = cv::Mat1b(gray.size(), uchar(0));
  cv::fillConvexPoly(*on_marker, outline, 255);
  return gray;
}

std::string causeIn(const cv::Mat1b& gray, const ToolDescription& tool) {
  cv::Mat3b color;
  cv::cvtColor(gray, color, cv::COLOR_GRAY2BGR);
  return whyMarkersAreMissed(tool, color);
}

/// How often a sentence is found among the causes of some images.
template <typename Change>
int named(const std::string& expected, const Change& change) {
  int count = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const ToolDescription tool = toolOf(static_cast<int>(seed) + 7);
    cv::Mat1b on_marker, gray = view(tool, seed, &on_marker);
    change(on_marker, &gray);
    if (!MarkerDetector(tool.dictionary).detect(gray).empty()) {
      ++count;  // a few markers look the same in a mirror
      continue;
    }
    const std::string cause = causeIn(gray, tool);
    EXPECT_TRUE(cause.empty() || cause.find(expected) != std::string::npos) << cause;
    count += cause.empty() ? 0 : 1;
  }
  return count;
}

TEST(MarkerAbsence, InvertedPrintsAreNamed) {
  EXPECT_GE(named("printed inverted", [](const cv::Mat1b& on_marker,
                                         cv::Mat1b* gray) { cv::bitwise_not(*gray, *gray, on_marker); }),
            8)
      << "on white paper";
  EXPECT_GE(
      named("printed inverted", [](const cv::Mat1b&, cv::Mat1b* gray) { cv::bitwise_not(*gray, *gray); }), 10)
      << "with the margin";
}

TEST(MarkerAbsence, MirroredPrintsAreNamed) {
  EXPECT_GE(named("mirrored", [](const cv::Mat1b&, cv::Mat1b* gray) { cv::flip(*gray, *gray, 0); }), 10);
}

TEST(MarkerAbsence, AMissingMarginIsNamed) {
  EXPECT_GE(named("white margin",
                  [](const cv::Mat1b& on_marker, cv::Mat1b* gray) { gray->setTo(25, on_marker == 0); }),
            8);
}

TEST(MarkerAbsence, AMarkerOfFewPixelsIsNamedWithItsSize) {
  int small = 0, other = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const ToolDescription tool = toolOf(7, 0.009 + 0.0004 * seed, "DICT_APRILTAG_36h11");
    const cv::Mat1b gray = view(tool, seed);
    if (!MarkerDetector(tool.dictionary).detect(gray).empty()) continue;
    const std::string cause = causeIn(gray, tool);
    (cause.find("pixels wide") != std::string::npos ? small : other) += cause.empty() ? 0 : 1;
  }
  EXPECT_GE(small, 2) << "still smaller ones cannot be read";
  EXPECT_EQ(other, 0);
}

TEST(MarkerAbsence, OtherIdsAndDictionariesAreNamed) {
  const std::string id = causeIn(view(toolOf(8), 1), toolOf(7));
  EXPECT_EQ(id, "the image shows marker 8 of DICT_4X4_50, but the tool YAML names 7");
  const std::string dictionary = causeIn(view(toolOf(8, 0.06, "DICT_APRILTAG_36h11"), 1), toolOf(8));
  EXPECT_EQ(dictionary,
            "the image shows marker 8 of DICT_APRILTAG_36h11, but the dictionary in the tool YAML is "
            "DICT_4X4_50");
}

TEST(MarkerAbsence, AnImageWithoutMarkersHasNoCause) {
  const ToolDescription nothing{"DICT_4X4_50", {}, Points(0, 3), {}};
  for (unsigned seed = 0; seed < 5; ++seed) EXPECT_EQ(causeIn(view(nothing, seed), toolOf(7)), "");
}

}  // namespace
}  // namespace softbody
