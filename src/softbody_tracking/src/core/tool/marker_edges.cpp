#include "tool/marker_edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "softbody_common/statistics/robust.h"

namespace softbody {
namespace {

constexpr double kCornerMargin = 0.08;    // part of a side left out at each end, where blur rounds the corner
constexpr double kStep_px = 0.5;          // [px] between samples of a profile
constexpr double kMinSlope = 0.25;        // of a profile's steepest slope; smaller slopes are noise
constexpr double kMinContrast = 15.0;     // grey levels across an edge
constexpr double kMinEdgeFraction = 0.6;  // of a side's profiles that must show an edge
constexpr double kMinBow_px = 0.3;  // [px] of bent paper or lens distortion; a smaller bow counts as straight
constexpr double kMaxBowResidual =
    0.85;                           // of the straight fit's mean deviation; a curve must fit better than this
constexpr double kCauchy_px = 0.3;  // [px] scale of the robust weights
constexpr int kMinProfiles = 8;     // across a side, however short
constexpr int kFitIterations = 3;   // reweighted least squares; converges in three
constexpr int kIntersectionSteps = 3;  // Newton steps to the corner of two curves

using Line = Eigen::Hyperplane<double, 2>;

/// Whether the four pixels around p are in the image.
bool isInside(const cv::Mat1b& gray, const Eigen::Vector2d& p) {
  return p.x() >= 0.0 && p.y() >= 0.0 && p.x() < gray.cols - 1.0 && p.y() < gray.rows - 1.0;
}

/// Between the four pixels around p, which are in the image.
double grayAt(const cv::Mat1b& gray, const Eigen::Vector2d& p) {
  const int u = static_cast<int>(p.x()), v = static_cast<int>(p.y());
  const double a = p.x() - u, b = p.y() - v;
  const std::uint8_t *upper = gray.ptr<std::uint8_t>(v) + u, *lower = gray.ptr<std::uint8_t>(v + 1) + u;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

/// Distance from p to the edge along the outward direction [px]: the centroid of the slope, because blur is
/// symmetric. @param slopes memory for the profile.
std::optional<double> edgeOffset(const cv::Mat1b& gray, const Eigen::Vector2d& p,
                                 const Eigen::Vector2d& outward, double reach_px,
                                 std::vector<double>* slopes) {
  const int steps = static_cast<int>(2.0 * reach_px / kStep_px);
  const auto place = [&](int i) -> Eigen::Vector2d { return p + (i * kStep_px - reach_px) * outward; };
  if (!isInside(gray, place(0)) || !isInside(gray, place(steps))) return std::nullopt;
  slopes->clear();
  double before = grayAt(gray, place(0));
  for (int i = 1; i <= steps; ++i) {
    const double here = grayAt(gray, place(i));
    slopes->push_back(here - before);
    before = here;
  }
  const double threshold = kMinSlope * *std::max_element(slopes->begin(), slopes->end());
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < slopes->size(); ++i) {
    const double slope = std::max(0.0, (*slopes)[i] - threshold);
    sum += slope;
    moment += slope * ((static_cast<double>(i) + 0.5) * kStep_px - reach_px);
  }
  if (sum < kMinContrast) return std::nullopt;
  return moment / sum;
}

/// One side's edge: its outward offset from the chord between the rough corners, as a polynomial of the place
/// along the chord, -0.5 to 0.5.
struct Side {
  Eigen::Vector2d from, chord, outward;
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();  ///< constant, linear, quadratic [px]

  double offsetAt(double place) const { return coefficients.dot(powers(place)); }
  static Eigen::Vector3d powers(double place) { return {1.0, place, place * place}; }
  /// The tangent at the place nearest to a point.
  Line tangentAt(const Eigen::Vector2d& p) const {
    const double place = (p - from).dot(chord) / chord.squaredNorm() - 0.5;
    const double slope = coefficients[1] + 2.0 * coefficients[2] * place;
    return Line::Through(pointAt(place), pointAt(place) + chord + slope * outward);
  }
  Eigen::Vector2d pointAt(double place) const {
    return from + (place + 0.5) * chord + offsetAt(place) * outward;
  }
};

/// Measured offsets of an edge at places along a side.
struct Profile {
  std::vector<double> places, offsets;  // [px]
};

/// Iteratively reweighted least squares with Cauchy weights. @param terms 2: a line; 3: a parabola.
Eigen::Vector3d fitPolynomial(const Profile& profile, int terms) {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  for (int fit = 0; fit < kFitIterations; ++fit) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < profile.places.size(); ++i) {
      const Eigen::Vector3d powers = Side::powers(profile.places[i]);
      const double distance = (profile.offsets[i] - coefficients.dot(powers)) / kCauchy_px;
      const double weight = fit == 0 ? 1.0 : cauchyWeighted(1.0, distance * distance);
      normal += weight * powers * powers.transpose();
      right += weight * profile.offsets[i] * powers;
    }
    coefficients.head(terms) = normal.topLeftCorner(terms, terms).ldlt().solve(right.head(terms));
  }
  return coefficients;
}

double meanDeviation(const Profile& profile, const Eigen::Vector3d& coefficients) {
  double sum = 0.0;
  for (std::size_t i = 0; i < profile.places.size(); ++i)
    sum += std::abs(profile.offsets[i] - coefficients.dot(Side::powers(profile.places[i])));
  return sum / static_cast<double>(profile.places.size());
}

std::optional<Side> findSide(const cv::Mat1b& gray, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                             double reach_px) {
  Side side;
  side.from = from;
  side.chord = to - from;
  const double length = side.chord.norm();
  // Clockwise in an image, whose y axis points down: outward is to the left.
  side.outward = Eigen::Vector2d(side.chord.y(), -side.chord.x()) / length;
  const int samples = std::max(kMinProfiles, static_cast<int>(length));
  Profile profile;
  std::vector<double> slopes;
  for (int i = 0; i < samples; ++i) {
    const double place = (1.0 - 2.0 * kCornerMargin) * (i / (samples - 1.0) - 0.5);
    const auto offset = edgeOffset(gray, from + (place + 0.5) * side.chord, side.outward, reach_px, &slopes);
    if (!offset) continue;
    profile.places.push_back(place);
    profile.offsets.push_back(*offset);
  }
  if (static_cast<double>(profile.places.size()) < kMinEdgeFraction * samples) return std::nullopt;
  const Eigen::Vector3d straight = fitPolynomial(profile, 2), bent = fitPolynomial(profile, 3);
  const bool is_bent = std::abs(bent[2]) / 4.0 > kMinBow_px &&
                       meanDeviation(profile, bent) < kMaxBowResidual * meanDeviation(profile, straight);
  side.coefficients = is_bent ? bent : straight;
  return side;
}

/// The intersection of two sides near a point.
Eigen::Vector2d intersection(const Side& a, const Side& b, Eigen::Vector2d p) {
  for (int k = 0; k < kIntersectionSteps; ++k) p = a.tangentAt(p).intersection(b.tangentAt(p));
  return p;
}

}  // namespace

bool refineQuadrilateral(const cv::Mat1b& gray, double reach_px, std::vector<cv::Point2f>* corners) {
  const auto corner = [&](std::size_t k) {
    return Eigen::Vector2d((*corners)[k % 4].x, (*corners)[k % 4].y);
  };
  std::vector<Side> sides;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto side = findSide(gray, corner(k), corner(k + 1), reach_px);
    if (!side) return false;
    sides.push_back(*side);
  }
  std::vector<cv::Point2f> refined;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d p = intersection(sides[(k + 3) % 4], sides[k], corner(k));
    if (!((p - corner(k)).norm() <= 2.0 * reach_px)) return false;
    refined.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  *corners = refined;
  return true;
}

}  // namespace softbody
