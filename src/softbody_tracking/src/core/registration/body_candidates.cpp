#include "registration/body_candidates.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "agreement/pose_cost.h"
#include "softbody_common/geometry/types.h"

namespace softbody {
namespace {

// RANSAC trials for one plane: enough to draw three points of a plane with a third of all points.
constexpr int kPlaneTrials = 150;
// Share of the measured pixels that a plane must hold; smaller ones are no background.
constexpr double kSmallestPlaneShare = 0.1;
// Largest depth step inside a part, in body diameters: parts of the body hide other parts.
constexpr double kLargestStep = 0.1;
// A part whose size differs by this factor is not the body: the rest of it may be hidden, or something
// touches it.
constexpr double kOtherSize = 2.0;

/// Size of a part, divided by that of the body if this is as wide as high.
double relativeSize(double spread_m, double diameter_m) { return spread_m / (M_SQRT1_2 * diameter_m); }

/// The points x with normal . x = offset.
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  bool holds(const Eigen::Vector3d& p) const {
    return std::abs(normal.dot(p) - offset) < kDoubt * depthSigma(p.z());
  }
  /// Whether a point lies on the plane or on the camera's side of it.
  bool reaches(const Eigen::Vector3d& p) const {
    return (offset > 0.0 ? normal.dot(p) - offset : offset - normal.dot(p)) < kDoubt * depthSigma(p.z());
  }
};

struct Cloud {
  cv::Mat1i index;  ///< of a pixel's point, -1: none
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Point> pixels;
  std::vector<bool> free;  ///< neither background nor of a foreign colour
};

Cloud makeCloud(const RgbdFrame& frame, const RegionColors& colors) {
  Cloud cloud;
  cloud.index = cv::Mat1i(frame.depth.size(), -1);
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const float z = frame.depth(v, u);
      if (!(z > 0.0f)) continue;
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
  cv::dilate(reached, grown, cv::Mat());
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
  while (const std::optional<Plane> plane = largestPlane(*cloud, open, &random)) {
    const auto rest = std::stable_partition(open.begin(), open.end(),
                                            [&](int i) { return plane->holds(cloud->points[i]); });
    const std::vector<int> on_it(open.begin(), rest);
    const bool background =
        relativeSize(spreadOf(largestPart(*cloud, *plane, on_it)), diameter_m) > kOtherSize;
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
  const double difference = std::abs(std::log(relativeSize(part.spread_m, diameter_m)));
  part.fits = difference <= std::log(kOtherSize);
  // The body that a user wants to track is usually close: many pixels are better.
  part.rating = 2.0 * difference - std::log(pixels);
  for (int k : points) part.pixels.push_back(cloud.pixels[k].y * cloud.index.cols + cloud.pixels[k].x);
  return part;
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

std::vector<DepthPart> findDepthParts(const RgbdFrame& frame, const RegionColors& colors, double diameter_m) {
  Cloud cloud = makeCloud(frame, colors);
  removePlanes(diameter_m, &cloud);
  // Smaller steps are noise.
  const double step_m = std::max(kDistanceScale_m, kLargestStep * diameter_m);
  std::vector<DepthPart> parts;
  std::vector<bool> free = cloud.free;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!free[i]) continue;
    const std::vector<int> points = takePart(cloud, static_cast<int>(i), step_m, &free);
    if (static_cast<int>(points.size()) >= kFewestPixels)
      parts.push_back(measuredPart(cloud, points, diameter_m));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const DepthPart& a, const DepthPart& b) { return a.rating < b.rating; });
  return parts;
}

std::vector<BodyCandidate> findBodyCandidates(const RgbdFrame& frame, const RegionColors& colors,
                                              double diameter_m) {
  std::vector<BodyCandidate> candidates;
  for (const DepthPart& part : findDepthParts(frame, colors, diameter_m))
    if (part.fits) candidates.push_back(part.candidate);
  return candidates;
}

}  // namespace softbody
