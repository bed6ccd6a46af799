#include <test_support/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "marker_board/marker_board.h"
#include "marker_board/marker_board_drawing.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

constexpr double kDotsPerInch = 150.0, kDotsPerMetre = kDotsPerInch / 0.0254;

/// Where a board's marker lies on the page [px], in the order of markerCorners.
Eigen::Matrix<double, 2, 4> onPage(const MarkerBoard& board, const ToolMarker& marker) {
  const Eigen::Matrix<double, 3, 4> corners = markerCorners(marker);
  Eigen::Matrix<double, 2, 4> pixels;
  pixels.row(0) = ((corners.row(0).array() + 0.5 * board.paper_width_m) * kDotsPerMetre - 0.5).matrix();
  pixels.row(1) = ((0.5 * board.paper_height_m - corners.row(1).array()) * kDotsPerMetre - 0.5).matrix();
  return pixels;
}

TEST(MarkerBoard, ItsImageIsDetectedToScale) {
  const struct {
    const char* dictionary;
    std::vector<int> ids;
    double size_m;
    const char* paper;
  } cases[] = {{"DICT_4X4_50", {7}, 0.064, "a4"},
               {"DICT_6X6_250", {0, 40, 249, 12, 5}, 0.04, "a4"},
               {"DICT_APRILTAG_36h11", {1, 2}, 0.05, "letter"}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.dictionary);
    const MarkerBoard board = layOutBoard(c.dictionary, c.ids, c.size_m, c.paper);
    const auto detections = MarkerDetector(c.dictionary).detect(boardImage(board, kDotsPerInch));
    ASSERT_EQ(detections.size(), c.ids.size());
    for (const MarkerDetection& detection : detections) {
      const auto marker = std::find_if(board.tool.markers.begin(), board.tool.markers.end(),
                                       [&](const ToolMarker& m) { return m.id == detection.id; });
      ASSERT_NE(marker, board.tool.markers.end());
      EXPECT_LT((detection.corners - onPage(board, *marker)).cwiseAbs().maxCoeff(), 0.3);
    }
  }
}

TEST(MarkerBoard, ItsYamlIsTheToolOnTheSheet) {
  const MarkerBoard board = layOutBoard("DICT_5X5_100", {3, 8, 20}, 0.05, "a4");
  const std::string path = testing::TempDir() + "board_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(path) << boardYaml(board);
  const ToolDescription read = loadToolDescription(path);
  std::filesystem::remove(path);
  ASSERT_EQ(read.markers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(markerCorners(read.markers[i]).isApprox(markerCorners(board.tool.markers[i]), 1e-5));
}

TEST(MarkerBoard, PdfAndSvgHaveThePapersSize) {
  const MarkerBoard board = layOutBoard("DICT_4X4_50", {7}, 0.064, "a4");
  const std::filesystem::path base = testing::TempDir() + "board_" + std::to_string(getpid());
  const auto content = [](const std::filesystem::path& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  writeBoardPdf(board, base.string() + ".pdf");
  writeBoardSvg(board, base.string() + ".svg");
  const std::string pdf = content(base.string() + ".pdf"), svg = content(base.string() + ".svg");
  EXPECT_TRUE(says(pdf, "MediaBox [ 0 0 595.27"));
  EXPECT_TRUE(says(svg, "width=\"595.27"));
  std::filesystem::remove(base.string() + ".pdf");
  std::filesystem::remove(base.string() + ".svg");
  EXPECT_THROW(writeBoardPdf(board, "/nowhere/board.pdf"), std::runtime_error);
}

/// The markers' white margins touch no other marker, the paper's edge or the free middle.
void expectFreeMargins(const MarkerBoard& sheet) {
  const auto& markers = sheet.tool.markers;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const double reach =
        markers[i].size_m * (0.5 + 1.0 / markerCells(sheet.tool.dictionary, markers[i].id).cols);
    const Eigen::Vector3d at = markers[i].T_tool_marker.translation();
    EXPECT_LT(std::abs(at.x()) + reach, 0.5 * sheet.paper_width_m);
    EXPECT_LT(std::abs(at.y()) + reach, 0.5 * sheet.paper_height_m);
    EXPECT_TRUE(std::abs(at.x()) - reach > 0.5 * sheet.free_width_m - 1e-9 ||
                std::abs(at.y()) - reach > 0.5 * sheet.free_height_m - 1e-9);
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d other = markers[j].T_tool_marker.translation();
      EXPECT_GT((at - other).cwiseAbs().maxCoeff(), 2.0 * reach - 1e-9) << i << ", " << j;
    }
  }
}

TEST(Sheet, EveryMarkerOfTheRingIsDetectedToScaleAroundAFreeMiddle) {
  for (const std::string& paper : paperNames()) {
    SCOPED_TRACE(paper);
    const MarkerBoard sheet = layOutSheet("DICT_4X4_100", {}, 0.0, paper);
    expectFreeMargins(sheet);
    EXPECT_GT(sheet.free_width_m, 0.5 * sheet.paper_width_m);
    const auto detections = MarkerDetector("DICT_4X4_100").detect(boardImage(sheet, kDotsPerInch));
    ASSERT_EQ(detections.size(), sheet.tool.markers.size());
    for (const MarkerDetection& detection : detections) {
      ASSERT_GE(detection.id, 50);
      const ToolMarker& marker = sheet.tool.markers.at(static_cast<std::size_t>(detection.id - 50));
      EXPECT_EQ(marker.id, detection.id);
      EXPECT_LT((detection.corners - onPage(sheet, marker)).cwiseAbs().maxCoeff(), 0.3);
    }
  }
}

TEST(Sheet, IsNotTakenForATool) {
  const cv::Mat1b image = boardImage(layOutSheet("DICT_4X4_100", {}, 0.0, "a4"), kDotsPerInch);
  EXPECT_TRUE(MarkerDetector("DICT_4X4_50").detect(image).empty());
}

TEST(Sheet, TheShippedFileIsThatOfMakeBoard) {
  std::ifstream file(SOURCE_DIR "/../softbody_bringup/config/sheet.yaml");
  const std::string shipped(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(shipped, boardYaml(layOutSheet("DICT_4X4_100", {}, 0.0, "a4")));
}

TEST(Sheet, TakesIdsAndSizesThatFit) {
  const MarkerBoard usual = layOutSheet("DICT_4X4_100", {}, 0.0, "a5");
  std::vector<int> ids(usual.tool.markers.size());
  std::iota(ids.begin(), ids.end(), 0);
  EXPECT_EQ(layOutSheet("DICT_4X4_50", ids, 0.0, "a5").tool.markers.back().id, ids.back());
  ids.pop_back();
  EXPECT_THROW(layOutSheet("DICT_4X4_50", ids, 0.0, "a5"), std::invalid_argument);
  EXPECT_THROW(layOutSheet("DICT_4X4_100", {}, 0.08, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutSheet("DICT_4X4_50", {}, 0.0, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutSheet("DICT_4X4_100", {}, 0.001, "a4"), std::invalid_argument);
}

TEST(MarkerBoard, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(layOutBoard("DICT_4X4_50", {7}, 0.18, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutBoard("DICT_4X4_50", {7, 7}, 0.03, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutBoard("DICT_4X4_50", {50}, 0.03, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutBoard("DICT_4X4_50", {}, 0.03, "a4"), std::invalid_argument);
  EXPECT_THROW(layOutBoard("DICT_4X4_50", {7}, 0.03, "b7"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
