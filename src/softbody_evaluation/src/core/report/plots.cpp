#include "report/plots.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody::evaluation {
namespace {

const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225), kCurve(180, 90, 20);
const cv::Size kPlotSize(900, 420);
const cv::Rect kPlotArea(80, 50, 790, 300);

void text(const std::string& words, const cv::Point& place, double scale, cv::Mat3b* image) {
  cv::putText(*image, words, place, cv::FONT_HERSHEY_SIMPLEX, scale, kInk, 1, cv::LINE_AA);
}

/// 1, 2 or 5 times a power of ten: about five steps up to `end`.
double gridStep(double end) {
  const double rough = end / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

/// Axes from zero to (end_x, end_y).
struct Axes {
  double end_x, end_y;

  cv::Point2d place(double x, double y) const {
    return {kPlotArea.x + kPlotArea.width * x / end_x, kPlotArea.br().y - kPlotArea.height * y / end_y};
  }
};

cv::Mat3b drawAxes(const std::string& title, const std::string& x_label, const Axes& axes) {
  cv::Mat3b image(kPlotSize, cv::Vec3b(255, 255, 255));
  for (double y = 0.0; y <= axes.end_y * 1.0001; y += gridStep(axes.end_y)) {
    cv::line(image, axes.place(0.0, y), axes.place(axes.end_x, y), kGrid);
    text(fmt::format("{:.4g}", y), axes.place(0.0, y) + cv::Point2d(-60.0, 5.0), 0.45, &image);
  }
  for (double x = 0.0; x <= axes.end_x * 1.0001; x += gridStep(axes.end_x)) {
    cv::line(image, axes.place(x, 0.0), axes.place(x, axes.end_y), kGrid);
    text(fmt::format("{:.4g}", x), axes.place(x, 0.0) + cv::Point2d(-10.0, 22.0), 0.45, &image);
  }
  cv::rectangle(image, kPlotArea, kInk);
  text(title, cv::Point(kPlotArea.x, 30), 0.6, &image);
  text(x_label, cv::Point(kPlotArea.br().x - 160, kPlotSize.height - 18), 0.5, &image);
  return image;
}

/// A positive end of an axis, for any data.
double axisEnd(double largest) { return largest > 0.0 && std::isfinite(largest) ? largest : 1.0; }

}  // namespace

cv::Mat3b linePlot(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                   const std::vector<double>& y) {
  const double largest = y.empty() ? 0.0 : *std::max_element(y.begin(), y.end());
  const Axes axes{axisEnd(x.empty() ? 0.0 : x.back()), 1.1 * axisEnd(largest)};
  cv::Mat3b image = drawAxes(title, x_label, axes);
  for (std::size_t i = 1; i < x.size(); ++i) {
    cv::line(image, axes.place(x[i - 1], y[i - 1]), axes.place(x[i], y[i]), kCurve, 2, cv::LINE_AA);
  }
  return image;
}

cv::Mat3b calibrationPlot(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                          const std::vector<double>& y) {
  double largest = x.empty() ? 0.0 : x.back();
  for (const double value : y) largest = std::max(largest, value);
  const Axes axes{1.1 * axisEnd(largest), 1.1 * axisEnd(largest)};
  cv::Mat3b image = drawAxes(title, x_label, axes);
  cv::line(image, axes.place(0.0, 0.0), axes.place(axes.end_x, axes.end_y), kInk, 1, cv::LINE_AA);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0)
      cv::line(image, axes.place(x[i - 1], y[i - 1]), axes.place(x[i], y[i]), kCurve, 2, cv::LINE_AA);
    cv::circle(image, axes.place(x[i], y[i]), 4, kCurve, cv::FILLED, cv::LINE_AA);
  }
  return image;
}

cv::Mat3b histogram(const std::string& title, const std::string& x_label, const std::vector<float>& values,
                    double scale) {
  constexpr int kBins = 60;
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const double end = axisEnd(sorted.empty() ? 0.0 : scale * sorted[(sorted.size() - 1) * 995 / 1000]);
  std::vector<double> shares(kBins, 0.0);
  for (const float value : values) {
    const int bin = std::clamp(static_cast<int>(kBins * scale * value / end), 0, kBins - 1);
    shares[static_cast<std::size_t>(bin)] += 100.0 / static_cast<double>(values.size());
  }
  const Axes axes{end, 1.1 * axisEnd(*std::max_element(shares.begin(), shares.end()))};
  cv::Mat3b image = drawAxes(title + ", percent per bin", x_label, axes);
  for (int bin = 0; bin < kBins; ++bin) {
    const cv::Point2d low = axes.place(end * bin / kBins, 0.0);
    const cv::Point2d high = axes.place(end * (bin + 1) / kBins, shares[static_cast<std::size_t>(bin)]);
    cv::rectangle(image, low, high - cv::Point2d(1.0, 0.0), kCurve, cv::FILLED);
  }
  return image;
}

void drawWireframe(const Pinhole& camera, const Points& vertices, const Triangles& triangles,
                   cv::Mat3b* image) {
  constexpr int kFractionBits = 4;
  cv::Mat3b lines = image->clone();
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    std::vector<cv::Point> corners;
    Eigen::Vector2d pixel[3];
    bool in_front = true;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = vertices.row(triangles(f, k));
      in_front = in_front && p.z() > 0.01;
      pixel[k] = camera.project(p);
      corners.emplace_back(static_cast<int>(std::lround(pixel[k].x() * (1 << kFractionBits))),
                           static_cast<int>(std::lround(pixel[k].y() * (1 << kFractionBits))));
    }
    const Eigen::Vector2d a = pixel[1] - pixel[0], b = pixel[2] - pixel[0];
    const bool faces_camera = a.x() * b.y() - a.y() * b.x() < 0.0;
    if (in_front && faces_camera) {
      cv::polylines(lines, corners, true, cv::Scalar(60, 255, 60), 1, cv::LINE_AA, kFractionBits);
    }
  }
  // Half transparent, so that the image stays visible below the lines.
  cv::addWeighted(lines, 0.5, *image, 0.5, 0.0, *image);
}

cv::Mat3b contactSheet(const std::vector<cv::Mat3b>& pictures, int columns) {
  if (pictures.empty()) return {};
  const cv::Size size = pictures.front().size();
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  cv::Mat3b sheet(rows * size.height, columns * size.width, cv::Vec3b(0, 0, 0));
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    const cv::Point place(i % columns * size.width, i / columns * size.height);
    pictures[static_cast<std::size_t>(i)].copyTo(sheet(cv::Rect(place, size)));
  }
  return sheet;
}

}  // namespace softbody::evaluation
