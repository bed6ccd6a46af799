#include "tool/borderless_markers.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace softbody {
namespace {

constexpr int kCell_px = 8;          // side of a cell in the rectified picture
constexpr double kMinCell_px = 2.0;  // smaller cells cannot be read
constexpr int kBrighter = 15;        // grey levels of a bright pixel above its surroundings
constexpr int kSmallestGap_px = 3, kLargestGap_px = 50;  // that is closed between the bright cells of a group
constexpr double kGapStep = 1.4;  // from one gap to the next: cells join before they join their surroundings
constexpr double kStraight = 0.02;  // of a group's perimeter: smaller bends in its outline count as straight
constexpr double kSurroundings = 6.0;  // part of the image's smaller side that counts as the surroundings

cv::Mat1b brightPixels(const cv::Mat1b& gray) {
  const int window = static_cast<int>(std::min(gray.rows, gray.cols) / kSurroundings) | 1;
  cv::Mat1b bright;
  cv::adaptiveThreshold(gray, bright, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY, std::max(3, window),
                        -kBrighter);
  return bright;
}

/// Cells of a square with a ring of one cell around it, 1 bright, 0 dark.
/// @param square the bits' corners in the image. @param bits along a side.
cv::Mat1b cellsOf(const cv::Mat1b& gray, const cv::RotatedRect& square, int bits) {
  const auto low = static_cast<float>(kCell_px), high = static_cast<float>((bits + 1) * kCell_px);
  const int side = (bits + 2) * kCell_px;
  std::vector<cv::Point2f> from(4);
  square.points(from.data());
  const std::vector<cv::Point2f> to{{low, high}, {low, low}, {high, low}, {high, high}};
  cv::Mat1b picture, cells(bits + 2, bits + 2);
  cv::warpPerspective(gray, picture, cv::getPerspectiveTransform(from, to), {side, side});
  cv::Mat1b black_and_white;
  cv::threshold(picture, black_and_white, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  for (int i = 0; i < cells.rows * cells.cols; ++i) {
    const cv::Rect inner(i % cells.cols * kCell_px + 1, i / cells.cols * kCell_px + 1, kCell_px - 2,
                         kCell_px - 2);
    cells(i / cells.cols, i % cells.cols) = cv::mean(black_and_white(inner))[0] > 127.0 ? 1 : 0;
  }
  return cells;
}

/// The rectangles around a group of cells that are parallel to one side of its convex outline. A group may
/// lack the cells at its corners.
std::vector<cv::RotatedRect> rectanglesAround(const std::vector<cv::Point>& group) {
  std::vector<cv::Point> hull, outline;
  cv::convexHull(group, hull);
  cv::approxPolyDP(hull, outline, kStraight * cv::arcLength(hull, true), true);
  std::vector<cv::RotatedRect> rectangles;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cv::Point2d side = outline[(i + 1) % outline.size()] - outline[i];
    const cv::Point2d u = side / cv::norm(side), v(-u.y, u.x);
    double low_u = 1e9, high_u = -1e9, low_v = 1e9, high_v = -1e9;
    for (const cv::Point2d p : hull) {
      low_u = std::min(low_u, p.dot(u)), high_u = std::max(high_u, p.dot(u));
      low_v = std::min(low_v, p.dot(v)), high_v = std::max(high_v, p.dot(v));
    }
    // Outlines run through the centres of pixels.
    const cv::Size2d size(high_u - low_u + 1.0, high_v - low_v + 1.0);
    rectangles.emplace_back(0.5 * (low_u + high_u) * u + 0.5 * (low_v + high_v) * v, size,
                            static_cast<float>(std::atan2(u.y, u.x) * 180.0 / CV_PI));
  }
  return rectangles;
}

std::optional<int> idOf(const cv::Mat1b& cells, const aruco::Dictionary& dictionary) {
  cv::Mat1b ring = cells.clone();
  const cv::Rect inside(1, 1, cells.cols - 2, cells.rows - 2);
  ring(inside) = 0;
  if (cv::countNonZero(ring) > 0) return std::nullopt;
  int id = 0, rotation = 0;
  if (!dictionary.identify(cells(inside).clone(), id, rotation, 0.0)) return std::nullopt;
  return id;
}

}  // namespace

std::vector<BorderlessMarker> borderlessMarkers(const cv::Mat1b& gray, const aruco::Dictionary& dictionary) {
  const cv::Mat1b bright = brightPixels(gray);
  const int bits = dictionary.markerSize;
  std::vector<BorderlessMarker> markers;
  for (double gap = kSmallestGap_px; gap < kLargestGap_px; gap *= kGapStep) {
    cv::Mat1b groups;
    const int kernel = static_cast<int>(gap) | 1;
    cv::morphologyEx(bright, groups, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_RECT, {kernel, kernel}));
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(groups, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
    for (const auto& outline : outlines) {
      for (const cv::RotatedRect& square : rectanglesAround(outline)) {
        const double shorter = std::min(square.size.width, square.size.height),
                     longer = std::max(square.size.width, square.size.height);
        if (shorter < kMinCell_px * bits || longer > 2.0 * shorter) continue;
        const auto id = idOf(cellsOf(gray, square, bits), dictionary);
        if (id) markers.push_back({*id, longer * (bits + 2) / bits});
      }
    }
  }
  return markers;
}

}  // namespace softbody
