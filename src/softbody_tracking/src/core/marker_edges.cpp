#include "core/marker_edges.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace softbody {
namespace {

constexpr double kFromCorner = 0.08;    ///< of a side that is left out at each end: rounded by blur
constexpr double kStep_px = 0.5;        ///< along a profile
constexpr double kWeakSlope = 0.25;     ///< of a profile's steepest; below is noise
constexpr double kWeakContrast = 15.0;  ///< grey levels
constexpr double kFewestPoints = 0.6;   ///< of a side's profiles that must show an edge
constexpr int kFits = 3;

using Line = Eigen::Hyperplane<double, 2>;

std::optional<double> grayAt(const cv::Mat1b& gray, const Eigen::Vector2d& p) {
  const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
  if (u < 0 || v < 0 || u + 1 >= gray.cols || v + 1 >= gray.rows) return std::nullopt;
  const double a = p.x() - u, b = p.y() - v;
  return (1 - b) * ((1 - a) * gray(v, u) + a * gray(v, u + 1)) +
         b * ((1 - a) * gray(v + 1, u) + a * gray(v + 1, u + 1));
}

/// Where brightness rises along a profile: the centroid of its slope, as blur is symmetric. [px from p]
std::optional<double> edgeOffset(const cv::Mat1b& gray, const Eigen::Vector2d& p,
                                 const Eigen::Vector2d& outward, double reach_px) {
  std::vector<double> slopes;
  std::optional<double> before = grayAt(gray, p - reach_px * outward);
  const int steps = static_cast<int>(2.0 * reach_px / kStep_px);
  for (int i = 1; i <= steps; ++i) {
    const std::optional<double> here = grayAt(gray, p + (i * kStep_px - reach_px) * outward);
    if (!before || !here) return std::nullopt;
    slopes.push_back(*here - *before);
    before = here;
  }
  const double weak = kWeakSlope * *std::max_element(slopes.begin(), slopes.end());
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const double slope = std::max(0.0, slopes[i] - weak);
    sum += slope;
    moment += slope * ((static_cast<double>(i) + 0.5) * kStep_px - reach_px);
  }
  if (sum < kWeakContrast) return std::nullopt;
  return moment / sum;
}

/// Total least squares with Cauchy weights about the last fit.
Line fitLine(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> weights(points.size(), 1.0);
  Line line;
  for (int fit = 0; fit < kFits; ++fit) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      mean += weights[i] * points[i];
      total += weights[i];
    }
    mean /= total;
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
      spread += weights[i] * (points[i] - mean) * (points[i] - mean).transpose();
    line = Line(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(0), mean);
    constexpr double kCauchy_px = 0.3;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = line.signedDistance(points[i]) / kCauchy_px;
      weights[i] = 1.0 / (1.0 + distance * distance);
    }
  }
  return line;
}

std::optional<Line> sideLine(const cv::Mat1b& gray, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                             double reach_px) {
  const Eigen::Vector2d along = to - from;
  const double length = along.norm();
  // Clockwise in an image, whose y axis points down: outward is to the left.
  const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()) / length;
  const int samples = std::max(8, static_cast<int>(length));
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < samples; ++i) {
    const double share = kFromCorner + (1.0 - 2.0 * kFromCorner) * i / (samples - 1.0);
    const Eigen::Vector2d p = from + share * along;
    if (const auto offset = edgeOffset(gray, p, outward, reach_px)) points.push_back(p + *offset * outward);
  }
  if (static_cast<double>(points.size()) < kFewestPoints * samples) return std::nullopt;
  return fitLine(points);
}

}  // namespace

bool refineQuadrilateral(const cv::Mat1b& gray, double reach_px, std::vector<cv::Point2f>* corners) {
  const auto corner = [&](std::size_t k) {
    return Eigen::Vector2d((*corners)[k % 4].x, (*corners)[k % 4].y);
  };
  std::vector<Line> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto line = sideLine(gray, corner(k), corner(k + 1), reach_px);
    if (!line) return false;
    sides.push_back(*line);
  }
  std::vector<cv::Point2f> refined;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d p = sides[(k + 3) % 4].intersection(sides[k]);
    if (!((p - corner(k)).norm() <= 2.0 * reach_px)) return false;
    refined.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  *corners = refined;
  return true;
}

}  // namespace softbody
