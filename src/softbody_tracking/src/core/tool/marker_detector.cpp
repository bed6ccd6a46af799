#include "softbody_tracking/tool/marker_detector.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tool/aruco.h"
#include "tool/marker_dictionary.h"
#include "tool/marker_edges.h"

namespace softbody {
namespace {

constexpr double kReach = 0.7;        // of a cell: stays within the black border, which is one cell wide
constexpr double kMinReach_px = 1.5;  // [px] the contour may be off by a pixel
constexpr double kMaxReach_px = 5.0;  // [px] a longer profile adds only noise

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

int markersInDictionary(const std::string& dictionary) {
  return uprightDictionary(dictionary).bytesList.rows;
}

cv::Mat1b markerCells(const std::string& dictionary, int id) {
  const aruco::Dictionary markers = uprightDictionary(dictionary);
  if (id < 0 || id >= markers.bytesList.rows) {
    throw std::invalid_argument(
        fmt::format("marker id is {}; allowed in {}: 0 to {}", id, dictionary, markers.bytesList.rows - 1));
  }
  return aruco::markerImage(markers, id, markers.markerSize + 2);
}

struct MarkerDetector::Implementation {
  Implementation(const std::string& name, const aruco::Dictionary& dictionary)
      : detector(dictionary), cells_a_side(dictionary.markerSize + 2) {
    requireCornerOrder(name, dictionary, detector);
  }

  aruco::Detector detector;
  int cells_a_side;
};

MarkerDetector::MarkerDetector(const std::string& dictionary)
    : implementation_(std::make_unique<Implementation>(dictionary, uprightDictionary(dictionary))) {}

MarkerDetector::~MarkerDetector() = default;

int MarkerDetector::cells() const { return implementation_->cells_a_side; }

std::vector<MarkerDetection> MarkerDetector::detect(const cv::Mat1b& gray, const cv::Rect& region,
                                                    int window_px) const {
  const cv::Rect all(0, 0, gray.cols, gray.rows);
  const cv::Rect place = region.empty() ? all : region & all;
  if (place.empty()) return {};
  const cv::Mat1b part = gray(place);
  std::vector<std::vector<cv::Point2f>> found;
  std::vector<int> ids;
  aruco::Options options;
  options.window_px = window_px;
  // The smallest marker is the same in a part of the image as in all of it.
  options.min_perimeter_rate *=
      static_cast<double>(std::max(all.width, all.height)) / std::max(place.width, place.height);
  implementation_->detector.detect(part, &found, &ids, options);
  std::vector<MarkerDetection> detections;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!refineCorners(part, implementation_->cells_a_side, &found[i])) continue;
    MarkerDetection detection;
    detection.id = ids[i];
    for (int k = 0; k < 4; ++k) {
      const cv::Point2f& corner = found[i][static_cast<std::size_t>(k)];
      detection.corners.col(k) << place.x + corner.x, place.y + corner.y;
    }
    detections.push_back(detection);
  }
  return detections;
}

}  // namespace softbody
