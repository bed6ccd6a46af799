#include <gtest/gtest.h>

#include <cstdint>

#include "fixtures/tool_scene.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

/// A published marker: its bits row by row from the top left, the first one most significant, 1 white.
struct Published {
  const char* dictionary;
  int id;
  std::uint64_t code;
};
/// Codes of the AprilTag families (Olson 2011; Wang and Olson 2016), and of ArUco markers as OpenCV draws
/// them.
constexpr Published kPublished[] = {
    {"DICT_APRILTAG_36h11", 0, 0xd5d628584},
    {"DICT_APRILTAG_36h11", 1, 0xd97f18b49},
    {"DICT_APRILTAG_36h11", 6, 0x056a5d085},
    {"DICT_APRILTAG_36h11", 9, 0x265ad0472},
    {"DICT_APRILTAG_25h9", 0, 0x155cbf1},
    {"DICT_APRILTAG_25h9", 1, 0x1e4d1b6},
    {"DICT_APRILTAG_25h9", 5, 0x03548bb},
    {"DICT_APRILTAG_16h5", 0, 0x231b},
    {"DICT_APRILTAG_36h10", 0, 0x1ca92a687},
    {"DICT_4X4_50", 0, 0xb532},
    {"DICT_4X4_1000", 0, 0xb532},
    {"DICT_6X6_250", 0, 0x1e3dd82a6},
};

/// Cells of a marker with its black border: black 0, white 255.
cv::Mat1b cellsOf(std::uint64_t code, int bits) {
  cv::Mat1b cells(bits + 2, bits + 2, uchar(0));
  for (int i = 0; i < bits * bits; ++i) {
    const bool white = (code >> (bits * bits - 1 - i) & 1) != 0;
    cells(1 + i / bits, 1 + i % bits) = white ? 255 : 0;
  }
  return cells;
}

TEST(MarkerDictionary, PrintsOfOthersHaveTheSameCornersAsOurs) {
  for (const Published& published : kPublished) {
    SCOPED_TRACE(std::string(published.dictionary) + " " + std::to_string(published.id));
    const cv::Mat1b ours = markerCells(published.dictionary, published.id);
    const cv::Mat1b theirs = cellsOf(published.code, ours.cols - 2);
    EXPECT_EQ(cv::norm(ours, theirs, cv::NORM_INF), 0.0);
    constexpr int kCell = 10;
    cv::Mat1b image(cv::Size(ours.cols + 4, ours.rows + 4) * kCell, uchar(255)), marker;
    cv::resize(theirs, marker, theirs.size() * kCell, 0, 0, cv::INTER_NEAREST);
    marker.copyTo(image(cv::Rect(cv::Point(2 * kCell, 2 * kCell), marker.size())));
    const auto detections = MarkerDetector(published.dictionary).detect(image);
    ASSERT_EQ(detections.size(), 1u);
    EXPECT_EQ(detections[0].id, published.id);
    const double low = 2.0 * kCell - 0.5, high = low + marker.cols;
    Eigen::Matrix<double, 2, 4> upright;
    upright << low, high, high, low, low, low, high, high;
    EXPECT_LT((detections[0].corners - upright).cwiseAbs().maxCoeff(), 0.6);
  }
}

}  // namespace
}  // namespace softbody
