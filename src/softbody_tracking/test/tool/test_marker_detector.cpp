#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "fixtures/tool_scene.h"
#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

/// Real photographs with corners from OpenCV's own tests. Only DISABLED_ tests read them: `make shared-data`.
const std::filesystem::path kBoards = std::filesystem::path(SOURCE_DIR) / "../../../shared/data/aruco_boards";

using Corners = Eigen::Matrix<double, 2, 4>;

cv::Mat1b grayOf(const RgbdFrame& frame) {
  cv::Mat1b gray;
  cv::cvtColor(frame.color, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

double cornerError(const MarkerDetection& detection, const Eigen::Matrix<double, 2, 4>& expected) {
  return (detection.corners - expected).colwise().norm().maxCoeff();
}

TEST(MarkerDetector, EveryDictionaryIsReadWithItsIdsAndCorners) {
  for (const std::string& dictionary : dictionaryNames()) {
    SCOPED_TRACE(dictionary);
    const int last = markersInDictionary(dictionary) - 1;
    const MarkerDetector detector(dictionary);
    for (const int id : {0, last / 3, last}) {
      const ToolDescription tool{dictionary, {toolMarker(id, 0.06)}, Points(0, 3), {}};
      std::mt19937 random(static_cast<unsigned>(id));
      const Eigen::Isometry3d T = slanted(0.5, &random);
      const RgbdFrame frame = renderTool(tool, T, 0, 1);
      const cv::Mat1b gray = grayOf(frame);
      const auto detections = detector.detect(gray);
      ASSERT_EQ(detections.size(), 1u);
      EXPECT_EQ(detections[0].id, id);
      Eigen::Matrix<double, 2, 4> expected;
      const Eigen::Matrix<double, 3, 4> corners = T * markerCorners(tool.markers[0]);
      for (int k = 0; k < 4; ++k) expected.col(k) = frame.camera.project(corners.col(k));
      EXPECT_LT(cornerError(detections[0], expected), 0.4);
    }
  }
}

TEST(MarkerDetector, SearchesOnlyTheRegionAndAnswersInTheImage) {
  const ToolDescription tool{"DICT_4X4_50", {toolMarker(7, 0.06)}, Points(0, 3), {}};
  const RgbdFrame frame = renderTool(tool, facing({0.0, 0.0, 0.5}), 0, 1);
  const cv::Mat1b gray = grayOf(frame);
  const MarkerDetector detector(tool.dictionary);
  const auto all = detector.detect(gray), part = detector.detect(gray, {240, 160, 180, 180});
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(part.size(), 1u);
  EXPECT_LT(cornerError(part[0], all[0].corners), 0.05);
  EXPECT_TRUE(detector.detect(gray, {0, 0, 120, 120}).empty());
  EXPECT_TRUE(detector.detect(gray, {2000, 0, 10, 10}).empty());
}

TEST(MarkerDetector, SidesOfBentPaperMeetInTheCornersAllTheSame) {
  const ToolDescription tool{"DICT_4X4_50", {toolMarker(7, 0.06)}, Points(0, 3), {}};
  const RgbdFrame frame = renderTool(tool, facing({0.0, 0.0, 0.5}), 0, 1);
  const cv::Mat1b gray = grayOf(frame);
  const MarkerDetector detector(tool.dictionary);
  const auto flat = detector.detect(gray);
  ASSERT_EQ(flat.size(), 1u);
  const double middle = flat[0].corners.row(0).mean(),
               half = (flat[0].corners.row(0).array() - middle).abs().maxCoeff();
  for (const double bow_px : {-1.5, -0.5, 0.5, 1.5}) {
    // Every column is moved down, the corners' by the bow and the middle one by nothing.
    cv::Mat1f map_u(gray.size()), map_v(gray.size());
    for (int v = 0; v < gray.rows; ++v) {
      for (int u = 0; u < gray.cols; ++u) {
        map_u(v, u) = static_cast<float>(u);
        map_v(v, u) = static_cast<float>(v - bow_px * std::pow((u - middle) / half, 2));
      }
    }
    cv::Mat1b bent;
    cv::remap(gray, bent, map_u, map_v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const auto detections = detector.detect(bent);
    ASSERT_EQ(detections.size(), 1u) << bow_px;
    Corners expected = flat[0].corners;
    expected.row(1).array() += bow_px;
    EXPECT_LT(cornerError(detections[0], expected), 0.25) << bow_px;
  }
}

TEST(MarkerDetector, UnknownDictionariesAreRefusedWithTheKnownNames) {
  const std::string said = complaint([&] { MarkerDetector detector("DICT_9X9_50"); });
  EXPECT_TRUE(says(said, "DICT_9X9_50"));
  EXPECT_TRUE(says(said, "DICT_4X4_50"));
  EXPECT_THROW(markerCells("DICT_4X4_50", 50), std::invalid_argument);
}

/// Five by seven markers on paper, as OpenCV's grid boards.
ToolDescription gridBoard(const std::string& dictionary) {
  ToolDescription board{dictionary, {}, Points(0, 3), {}};
  for (int k = 0; k < 35; ++k) {
    const Eigen::Translation3d place(0.05 * (k % 5 - 2), 0.05 * (3 - k / 5), 0.0);
    board.markers.push_back(toolMarker(k, 0.04, Eigen::Isometry3d(place)));
  }
  return board;
}

/// What a photograph adds to a rendered image: other dark squares, a shadow with a soft edge, lens blur,
/// noise.
cv::Mat1b photographed(const cv::Mat1b& rendered, double blur_px, double noise, std::mt19937* random) {
  cv::Mat1f gray;
  rendered.convertTo(gray, CV_32F);
  for (int k = 0; k < 6; ++k) {
    const cv::RotatedRect square(cv::Point2f(40.0f, 60.0f + 70.0f * static_cast<float>(k)), {34.0f, 34.0f},
                                 20.0f * static_cast<float>(k));
    std::array<cv::Point2f, 4> corners;
    square.points(corners.data());
    std::vector<cv::Point> outline(corners.begin(), corners.end());
    cv::fillConvexPoly(gray, outline, 30.0f);
  }
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<float> normal(0.0f, static_cast<float>(noise));
  const double direction = M_PI * uniform(*random), offset = 60.0 * uniform(*random);
  for (int v = 0; v < gray.rows; ++v) {
    for (int u = 0; u < gray.cols; ++u) {
      const double into_shadow = std::cos(direction) * (u - 320) + std::sin(direction) * (v - 240) - offset;
      gray(v, u) *= static_cast<float>(1.0 - 0.275 * (1.0 + std::tanh(into_shadow / 15.0)));
    }
  }
  cv::GaussianBlur(gray, gray, cv::Size(), blur_px);
  for (float& value : gray) value += normal(*random);
  cv::Mat1b bytes;
  gray.convertTo(bytes, CV_8U);
  return bytes;
}

/// A dictionary of one's own: the first markers of one of OpenCV's, the other way round.
std::string writeDictionary(const std::string& of) {
  const std::string path = ::testing::TempDir() + "marker_detector_dictionary.yml";
  cv::FileStorage file(path, cv::FileStorage::WRITE);
  file << "nmarkers" << 35 << "markersize" << 6 << "maxCorrectionBits" << 5;
  for (int id = 0; id < 35; ++id) {
    std::string bits;
    const cv::Mat1b cells = markerCells(of, 34 - id);
    for (const uchar cell : cv::Mat1b(cells(cv::Rect(1, 1, 6, 6)).clone())) bits += cell == 0 ? '0' : '1';
    file << "marker_" + std::to_string(id) << bits;
  }
  return path;
}

TEST(MarkerDetector, BoardsUnderShadowBlurAndNoiseGiveEveryIdAndNoOther) {
  std::mt19937 random(5);
  int all = 0, far = 0;
  for (const std::string& dictionary : {std::string("DICT_6X6_250"), writeDictionary("DICT_6X6_250")}) {
    const ToolDescription board = gridBoard(dictionary);
    const MarkerDetector detector(dictionary);
    for (const double tilt_rad : {0.1, 0.4, 0.7}) {
      const double direction = 10.0 * tilt_rad;
      const Eigen::Isometry3d T =
          facing({0.02, -0.01, 0.6}) *
          Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0));
      const RgbdFrame frame = renderTool(board, T, 0, 1, {0.0, 0.0, 0.0});
      for (const double blur_px : {0.6, 1.2}) {
        SCOPED_TRACE(dictionary + ", tilt " + std::to_string(tilt_rad) + ", blur " + std::to_string(blur_px));
        const auto detections = detector.detect(photographed(grayOf(frame), blur_px, 4.0, &random));
        EXPECT_EQ(detections.size(), board.markers.size());
        for (const MarkerDetection& detection : detections) {
          const Eigen::Matrix<double, 3, 4> corners =
              T * markerCorners(board.markers.at(static_cast<std::size_t>(detection.id)));
          Corners expected;
          for (int k = 0; k < 4; ++k) expected.col(k) = frame.camera.project(corners.col(k));
          const double error = cornerError(detection, expected);
          EXPECT_LT(error, 1.0) << "id " << detection.id;
          far += error > 0.5;
          ++all;
        }
      }
    }
  }
  std::cout << far << " of " << all << " markers with a corner off by more than half a pixel\n";
  EXPECT_LE(far, all / 100);
}

/// The known corners are the outermost dark pixels of a contour, whose centres lie half a pixel inside of the
/// two edges that meet there.
Corners onEdges(const Corners& contour) {
  Corners corners;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d here = contour.col(k), before = contour.col((k + 3) % 4),
                          after = contour.col((k + 1) % 4);
    corners.col(k) = here + 0.5 * ((here - before).normalized() + (here - after).normalized());
  }
  return corners;
}

/// Corners of contours, in whole pixels.
std::map<int, Corners> goldCorners(const YAML::Node& markers) {
  std::map<int, Corners> gold;
  for (const auto& entry : markers) {
    Corners& corners = gold[entry.first.as<int>()];
    for (int k = 0; k < 4; ++k)
      corners.col(k) << entry.second[k][0].as<double>(), entry.second[k][1].as<double>();
  }
  return gold;
}

/// Where OpenCV's refinement by gradients, another method than the detector's, takes corners.
Corners bySubPix(const cv::Mat1b& gray, const Corners& corners) {
  std::vector<cv::Point2f> points;
  for (int k = 0; k < 4; ++k)
    points.emplace_back(static_cast<float>(corners(0, k)), static_cast<float>(corners(1, k)));
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 0.01);
  cv::cornerSubPix(gray, points, cv::Size(2, 2), cv::Size(-1, -1), criteria);
  Corners refined;
  for (int k = 0; k < 4; ++k) refined.col(k) << points[k].x, points[k].y;
  return refined;
}

/// Within a pixel of the known corner. A contour does not reach the tip of a blurred corner: where the known
/// one lies inside by more, the photograph must say so by another method too, and that may be rare.
TEST(MarkerDetector, DISABLED_PhotographedBoardsGiveEveryKnownIdAndNoOther) {
  const YAML::Node gold = YAML::LoadFile((kBoards / "gold_corners.json").string());
  int all = 0, far = 0;
  for (const auto& entry : gold) {
    const auto image = entry.first.as<std::string>();
    SCOPED_TRACE(image);
    if (!entry.second.IsMap() || !entry.second["markers"]) continue;
    auto dictionary = entry.second["dictionary"].as<std::string>();
    if (dictionary.find('.') != std::string::npos) dictionary = (kBoards / dictionary).string();
    const auto expected = goldCorners(entry.second["markers"]);
    const cv::Mat1b gray = cv::imread((kBoards / image).string(), cv::IMREAD_GRAYSCALE);
    const auto detections = MarkerDetector(dictionary).detect(gray);
    EXPECT_EQ(detections.size(), expected.size());
    for (const MarkerDetection& detection : detections) {
      ASSERT_EQ(expected.count(detection.id), 1u) << "false id " << detection.id;
      const Corners& contour = expected.at(detection.id);
      const Corners known = onEdges(contour), refined = bySubPix(gray, contour);
      for (int k = 0; k < 4; ++k, ++all) {
        if ((detection.corners.col(k) - known.col(k)).cwiseAbs().maxCoeff() <= 1.0) continue;
        ++far;
        EXPECT_LT((detection.corners.col(k) - refined.col(k)).norm(), 0.3)
            << "id " << detection.id << " corner " << k;
      }
    }
  }
  EXPECT_LE(far, all / 100) << "of " << all;
}

}  // namespace
}  // namespace softbody
