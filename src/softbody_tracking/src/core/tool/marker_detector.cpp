#include "softbody_tracking/tool/marker_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tool/aruco.h"
#include "tool/marker_edges.h"

namespace softbody {
namespace {

// With OpenCV's default, the edge of a bright plate around a marker can suppress the marker.
constexpr double kMinMarkerDistanceRate = 0.02;
constexpr double kReach = 0.7;        // of a cell: stays within the black border, which is one cell wide
constexpr double kMinReach_px = 1.5;  // [px] the contour may be off by a pixel
constexpr double kMaxReach_px = 5.0;  // [px] a longer profile adds only noise

const std::map<std::string, int>& predefined() {
  using namespace cv::aruco;
  static const std::map<std::string, int> kNames{{"DICT_4X4_50", DICT_4X4_50},
                                                 {"DICT_4X4_100", DICT_4X4_100},
                                                 {"DICT_4X4_250", DICT_4X4_250},
                                                 {"DICT_4X4_1000", DICT_4X4_1000},
                                                 {"DICT_5X5_50", DICT_5X5_50},
                                                 {"DICT_5X5_100", DICT_5X5_100},
                                                 {"DICT_5X5_250", DICT_5X5_250},
                                                 {"DICT_5X5_1000", DICT_5X5_1000},
                                                 {"DICT_6X6_50", DICT_6X6_50},
                                                 {"DICT_6X6_100", DICT_6X6_100},
                                                 {"DICT_6X6_250", DICT_6X6_250},
                                                 {"DICT_6X6_1000", DICT_6X6_1000},
                                                 {"DICT_7X7_50", DICT_7X7_50},
                                                 {"DICT_7X7_100", DICT_7X7_100},
                                                 {"DICT_7X7_250", DICT_7X7_250},
                                                 {"DICT_7X7_1000", DICT_7X7_1000},
                                                 {"DICT_ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
                                                 {"DICT_APRILTAG_16h5", DICT_APRILTAG_16h5},
                                                 {"DICT_APRILTAG_25h9", DICT_APRILTAG_25h9},
                                                 {"DICT_APRILTAG_36h10", DICT_APRILTAG_36h10},
                                                 {"DICT_APRILTAG_36h11", DICT_APRILTAG_36h11}};
  return kNames;
}

aruco::Dictionary readDictionaryFile(const std::string& path) try {
  const cv::FileStorage file(path, cv::FileStorage::READ);
  aruco::Dictionary dictionary;
  if (!dictionary.readDictionary(file.root()) || dictionary.bytesList.empty())
    throw std::invalid_argument(path +
                                " is not a marker dictionary: nmarkers, markersize or marker_0 is missing");
  return dictionary;
} catch (const cv::Exception& error) {
  throw std::invalid_argument(fmt::format("{} is not a marker dictionary: {}", path, error.err));
}

aruco::Dictionary findDictionary(const std::string& name) {
  const auto found = predefined().find(name);
  if (found != predefined().end()) return aruco::predefinedDictionary(found->second);
  if (std::filesystem::is_regular_file(name)) return readDictionaryFile(name);
  throw std::invalid_argument(fmt::format("the marker dictionary '{}' is unknown; known: {}, or a file", name,
                                          fmt::join(dictionaryNames(), ", ")));
}

/// Refines the corners twice, because the detector's contour may be off by a pixel. The reach stays within
/// the black border, which has other edges inside. @return false if the image does not show all four edges.
bool refineCorners(const cv::Mat1b& gray, int cells_a_side, std::vector<cv::Point2f>* corners) {
  double side = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < 4; ++k)
    side = std::min(side, cv::norm((*corners)[k] - (*corners)[(k + 1) % 4]));
  const double reach_px = std::clamp(kReach * side / cells_a_side, kMinReach_px, kMaxReach_px);
  return refineQuadrilateral(gray, reach_px, corners) && refineQuadrilateral(gray, reach_px, corners);
}

}  // namespace

std::vector<std::string> dictionaryNames() {
  std::vector<std::string> names;
  for (const auto& [name, number] : predefined()) names.push_back(name);
  return names;
}

int markersInDictionary(const std::string& dictionary) { return findDictionary(dictionary).bytesList.rows; }

cv::Mat1b markerCells(const std::string& dictionary, int id) {
  const aruco::Dictionary markers = findDictionary(dictionary);
  if (id < 0 || id >= markers.bytesList.rows) {
    throw std::invalid_argument(
        fmt::format("marker id is {}; allowed in {}: 0 to {}", id, dictionary, markers.bytesList.rows - 1));
  }
  return aruco::markerImage(markers, id, markers.markerSize + 2);
}

struct MarkerDetector::Implementation {
  explicit Implementation(const aruco::Dictionary& dictionary)
      : detector(dictionary, kMinMarkerDistanceRate), cells_a_side(dictionary.markerSize + 2) {}

  aruco::Detector detector;
  int cells_a_side;
};

MarkerDetector::MarkerDetector(const std::string& dictionary)
    : implementation_(std::make_unique<Implementation>(findDictionary(dictionary))) {}

MarkerDetector::~MarkerDetector() = default;

std::vector<MarkerDetection> MarkerDetector::detect(const cv::Mat1b& gray, const cv::Rect& region) const {
  const cv::Rect all(0, 0, gray.cols, gray.rows);
  const cv::Rect part = region.empty() ? all : region & all;
  if (part.empty()) return {};
  std::vector<std::vector<cv::Point2f>> found;
  std::vector<int> ids;
  implementation_->detector.detect(gray(part), &found, &ids);
  std::vector<MarkerDetection> detections;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (cv::Point2f& corner : found[i]) corner += cv::Point2f(part.tl());
    if (!refineCorners(gray, implementation_->cells_a_side, &found[i])) continue;
    MarkerDetection detection;
    detection.id = ids[i];
    for (int k = 0; k < 4; ++k) {
      const cv::Point2f& corner = found[i][static_cast<std::size_t>(k)];
      detection.corners.col(k) << corner.x, corner.y;
    }
    detections.push_back(detection);
  }
  return detections;
}

}  // namespace softbody
