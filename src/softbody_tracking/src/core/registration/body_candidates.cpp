#include "registration/body_candidates.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "softbody_common/types.h"

namespace softbody {
namespace {

// RANSAC trials for one plane: enough to draw three points of a plane with a third of all points.
constexpr int kPlaneTrials = 150;
// Planes that are tested: a table, a wall and the floor.
constexpr int kMostPlanes = 3;
// Half the thickness of a plane [m] at 1 m; it grows with the square of the distance, as stereo noise does.
constexpr double kPlaneThickness = 0.008;
// Share of the measured pixels that a plane must hold; smaller ones are no background.
constexpr double kSmallestPlaneShare = 0.1;
// Size of a plane, in body diameters, from which it is background; the body itself may be flat.
constexpr double kPlaneBeyondBody = 1.3;
// Width [px] of the gap without depth between an object and what it hides.
constexpr int kUnmeasuredEdge = 2;
// Largest depth steps inside a candidate, in body diameters. All are tried: parts of the body hide other
// parts.
constexpr double kSteps[] = {0.05, 0.1, 0.15};
// Smallest such step [m]; below it noise would divide a small body.
constexpr double kSmallestStep = 0.02;
// A step must exceed the one before by this factor to give other candidates.
constexpr double kNextStep = 1.01;
// Distance of two centres, in body diameters, below which the second candidate is a repetition.
constexpr double kSamePlace = 0.1;
// Part of the diameter that one view of a body usually shows.
constexpr double kLikelyShare = 0.8;
// Size of a candidate in body diameters; the rest of the body may be hidden, or another object may touch it.
constexpr double kSmallestShare = 0.3, kLargestShare = 1.6;
// The thickness of planes does not fall below this factor at close range.
constexpr double kThinnest = 0.5;

/// The points x with normal . x = offset.
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  static double thickness(const Eigen::Vector3d& p) {
    return kPlaneThickness * std::max(kThinnest, p.z() * p.z());
  }
  bool holds(const Eigen::Vector3d& p) const { return std::abs(normal.dot(p) - offset) < thickness(p); }
  /// Whether a point lies on the plane or on the camera's side of it.
  bool reaches(const Eigen::Vector3d& p) const {
    return (offset > 0.0 ? normal.dot(p) - offset : offset - normal.dot(p)) < thickness(p);
  }
};

struct Cloud {
  cv::Mat1i index;  ///< of a pixel's point, -1: none
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Point> pixels;
  std::vector<bool> free;  ///< neither background nor of a foreign colour
};

Cloud makeCloud(const RgbdFrame& frame, const ColorModel& colors) {
  Cloud cloud;
  cloud.index = cv::Mat1i(frame.depth.size(), -1);
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const float z = frame.depth(v, u);
      if (z <= 0.0f) continue;
      cloud.index(v, u) = static_cast<int>(cloud.points.size());
      cloud.points.push_back(frame.camera.unproject(u, v, z));
      cloud.pixels.emplace_back(u, v);
      cloud.free.push_back(colors.belongs(frame.color(v, u)));
    }
  }
  return cloud;
}

std::optional<Plane> planeThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                  const Eigen::Vector3d& c) {
  const Eigen::Vector3d n = (b - a).cross(c - a);
  if (n.norm() < 1e-6) return std::nullopt;
  return Plane{n.normalized(), n.normalized().dot(a)};
}

/// The plane with most of the given points (RANSAC, Fischler and Bolles 1981); empty if it holds too few.
std::optional<Plane> largestPlane(const Cloud& cloud, const std::vector<int>& open, std::mt19937* random) {
  if (open.size() < 3) return std::nullopt;
  std::uniform_int_distribution<std::size_t> pick(0, open.size() - 1);
  std::optional<Plane> best;
  std::size_t most = 0;
  for (int trial = 0; trial < kPlaneTrials; ++trial) {
    const std::size_t a = pick(*random), b = pick(*random), c = pick(*random);
    const auto plane = planeThrough(cloud.points[open[a]], cloud.points[open[b]], cloud.points[open[c]]);
    if (!plane) continue;
    const auto on_it = static_cast<std::size_t>(
        std::count_if(open.begin(), open.end(), [&](int i) { return plane->holds(cloud.points[i]); }));
    if (on_it > most) most = on_it, best = plane;
  }
  if (static_cast<double>(most) < kSmallestPlaneShare * static_cast<double>(cloud.points.size()))
    return std::nullopt;
  return best;
}

/// Pixels that show the plane, or something nearer that may hide it, and the gaps in depth beside these.
cv::Mat1b extent(const Cloud& cloud, const Plane& plane) {
  cv::Mat1b reached(cloud.index.size(), 0), grown;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (plane.reaches(cloud.points[i])) reached(cloud.pixels[i]) = 1;
  cv::dilate(reached, grown, cv::Mat(), cv::Point(-1, -1), kUnmeasuredEdge);
  grown.copyTo(reached, cloud.index < 0);
  return reached;
}

/// The plane's points in the largest connected part of its extent.
std::vector<Eigen::Vector3d> largestPart(const Cloud& cloud, const Plane& plane,
                                         const std::vector<int>& points) {
  cv::Mat1i labels;
  const int count = cv::connectedComponents(extent(cloud, plane), labels);
  std::vector<std::vector<Eigen::Vector3d>> parts(static_cast<std::size_t>(count));
  for (int i : points) parts[labels(cloud.pixels[i])].push_back(cloud.points[i]);
  return *std::max_element(parts.begin(), parts.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

/// Marks the points of planes larger than the body as not free. Only the largest connected part counts for
/// the size, so that distant objects on the plane of a flat body do not make it background.
void removePlanes(double diameter_m, Cloud* cloud) {
  std::vector<int> open;
  for (std::size_t i = 0; i < cloud->points.size(); ++i)
    if (cloud->free[i]) open.push_back(static_cast<int>(i));
  std::mt19937 random(1);
  for (int k = 0; k < kMostPlanes; ++k) {
    const std::optional<Plane> plane = largestPlane(*cloud, open, &random);
    if (!plane) return;
    const auto rest = std::stable_partition(open.begin(), open.end(),
                                            [&](int i) { return plane->holds(cloud->points[i]); });
    const std::vector<int> on_it(open.begin(), rest);
    const bool background = spreadOf(largestPart(*cloud, *plane, on_it)) >= kPlaneBeyondBody * diameter_m;
    for (int i : on_it) cloud->free[i] = !background;
    open.erase(open.begin(), rest);
  }
}

/// The free points connected with a seed; they are marked as no longer free.
std::vector<int> takePart(const Cloud& cloud, int seed, double step_m, std::vector<bool>* free) {
  const cv::Rect inside(cv::Point(), cloud.index.size());
  std::vector<int> part, open{seed};
  (*free)[seed] = false;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    part.push_back(i);
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const cv::Point next = cloud.pixels[i] + cv::Point(du, dv);
        const int j = inside.contains(next) ? cloud.index(next) : -1;
        if (j < 0 || !(*free)[j] || std::abs(cloud.points[j].z() - cloud.points[i].z()) > step_m) continue;
        (*free)[j] = false;
        open.push_back(j);
      }
    }
  }
  return part;
}

/// Extents along the principal axes, the largest first [m].
Eigen::Vector3d principalSize(const std::vector<Eigen::Vector3d>& points) {
  Points rows(static_cast<Eigen::Index>(points.size()), 3);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = points[static_cast<std::size_t>(i)];
  const Points arms = rows.rowwise() - rows.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(arms.transpose() * arms);
  const Points along = arms * axes.eigenvectors();
  return (along.colwise().maxCoeff() - along.colwise().minCoeff()).reverse().transpose();
}

DepthPart measuredPart(const Cloud& cloud, const std::vector<int>& points, double diameter_m) {
  DepthPart part;
  std::vector<Eigen::Vector3d> places;
  const cv::Rect inner(1, 1, cloud.index.cols - 2, cloud.index.rows - 2);
  for (int k : points) {
    places.push_back(cloud.points[k]);
    part.at_border = part.at_border || !inner.contains(cloud.pixels[k]);
  }
  const int pixels = static_cast<int>(places.size());
  part.candidate = {Eigen::Vector3d::Zero(), pixels};
  for (const Eigen::Vector3d& p : places) part.candidate.center += p / pixels;
  part.size_m = principalSize(places);
  part.spread_m = spreadOf(places);
  const double share = part.spread_m / diameter_m;
  part.fits = share >= kSmallestShare && share <= kLargestShare;
  // The body that a user wants to track is usually close: many pixels are better.
  part.rating = 2.0 * std::abs(std::log(share / kLikelyShare)) - std::log(pixels);
  for (int k : points) part.pixels.push_back(cloud.pixels[k].y * cloud.index.cols + cloud.pixels[k].x);
  return part;
}

/// Adds the connected parts.
void addParts(const Cloud& cloud, double step_m, double diameter_m, std::vector<DepthPart>* parts) {
  std::vector<bool> free = cloud.free;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!free[i]) continue;
    const std::vector<int> points = takePart(cloud, static_cast<int>(i), step_m, &free);
    if (static_cast<int>(points.size()) >= kFewestPixels)
      parts->push_back(measuredPart(cloud, points, diameter_m));
  }
}

/// Whether one part contains the other. Parts found with different depth steps are nested or disjoint.
bool nested(const DepthPart& a, const DepthPart& b) {
  const bool a_is_smaller = a.pixels.size() < b.pixels.size();
  const std::vector<int>& smaller = (a_is_smaller ? a : b).pixels;
  const std::vector<int>& larger = (a_is_smaller ? b : a).pixels;
  return std::find(larger.begin(), larger.end(), smaller.front()) != larger.end();
}

/// One part of each separate object first, then the other parts; both sorted by rating.
std::vector<DepthPart> onePerObjectFirst(std::vector<DepthPart> parts) {
  std::stable_sort(parts.begin(), parts.end(),
                   [](const DepthPart& a, const DepthPart& b) { return a.rating < b.rating; });
  std::vector<DepthPart> firsts, others;
  for (DepthPart& part : parts) {
    const bool is_first = std::none_of(firsts.begin(), firsts.end(),
                                       [&](const DepthPart& other) { return nested(part, other); });
    (is_first ? firsts : others).push_back(std::move(part));
  }
  std::move(others.begin(), others.end(), std::back_inserter(firsts));
  return firsts;
}

}  // namespace

double spreadOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points) sum += (p - mean).squaredNorm();
  return std::sqrt(6.0 * sum / static_cast<double>(points.size()));
}

std::vector<DepthPart> findDepthParts(const RgbdFrame& frame, const ColorModel& colors, double diameter_m) {
  Cloud cloud = makeCloud(frame, colors);
  removePlanes(diameter_m, &cloud);
  std::vector<DepthPart> parts;
  double last_step_m = 0.0;
  for (const double step : kSteps) {
    const double step_m = std::max(kSmallestStep, step * diameter_m);
    if (step_m > kNextStep * last_step_m) addParts(cloud, step_m, diameter_m, &parts);
    last_step_m = step_m;
  }
  return parts;
}

std::vector<BodyCandidate> findBodyCandidates(const RgbdFrame& frame, const ColorModel& colors,
                                              double diameter_m) {
  std::vector<DepthPart> parts = findDepthParts(frame, colors, diameter_m);
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const DepthPart& part) { return !part.fits; }),
              parts.end());
  std::vector<BodyCandidate> candidates;
  for (const DepthPart& part : onePerObjectFirst(std::move(parts))) {
    const bool is_new = std::none_of(candidates.begin(), candidates.end(), [&](const BodyCandidate& other) {
      return (other.center - part.candidate.center).norm() < kSamePlace * diameter_m;
    });
    if (is_new) candidates.push_back(part.candidate);
  }
  return candidates;
}

}  // namespace softbody
