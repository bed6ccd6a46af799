#include "object_candidates.h"

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

constexpr int kPlaneTrials = 150;
constexpr int kMostPlanes = 3;
constexpr double kPlaneThickness = 0.008;       // [m] at 1 m; grows with the square of the distance
constexpr double kSmallestPlaneShare = 0.1;     // of the measured pixels
constexpr double kPlaneBeyondBody = 1.3;        // diameters that a background plane spans
constexpr double kSteps[] = {0.05, 0.1, 0.15};  // of the body's diameter, between neighbours of one piece
constexpr double kSmallestStep = 0.02;          // [m]
constexpr double kSamePlace = 0.1;              // of the body's diameter
constexpr double kLikelyShare = 0.8;            // of a body's diameter that one view shows
constexpr int kFewestPixels = 25;
constexpr double kSmallestShare = 0.3, kLargestShare = 1.6;  // of the body's diameter

/// n . x = offset
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  bool holds(const Eigen::Vector3d& p) const {
    return std::abs(normal.dot(p) - offset) < kPlaneThickness * std::max(0.5, p.z() * p.z());
  }
};

struct Cloud {
  cv::Mat1i index;  ///< of a pixel's point, -1: none
  std::vector<Eigen::Vector3d> points;
  std::vector<cv::Point> pixels;
  std::vector<bool> free;  ///< neither background nor of another colour
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

/// Root mean square distance from the centre, times the factor that makes it the side of an even square.
double spread(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points) sum += (p - mean).squaredNorm();
  return std::sqrt(6.0 * sum / static_cast<double>(points.size()));
}

/// The largest plane among some points (RANSAC, Fischler and Bolles 1981); nothing where it holds too few.
/// @return those that lie on it.
std::vector<int> largestPlane(const Cloud& cloud, const std::vector<int>& open, std::mt19937* random) {
  if (open.size() < 3) return {};
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
  if (!best || static_cast<double>(most) < kSmallestPlaneShare * static_cast<double>(cloud.points.size()))
    return {};
  std::vector<int> on_it;
  for (int i : open)
    if (best->holds(cloud.points[i])) on_it.push_back(i);
  return on_it;
}

/// Of some points the most that are connected in the image.
std::vector<Eigen::Vector3d> largestPart(const Cloud& cloud, const std::vector<int>& points) {
  cv::Mat1b mask(cloud.index.size(), 0);
  for (int i : points) mask(cloud.pixels[i]) = 1;
  cv::Mat1i labels;
  const int count = cv::connectedComponents(mask, labels);
  std::vector<std::vector<Eigen::Vector3d>> parts(static_cast<std::size_t>(count));
  for (int i : points) parts[labels(cloud.pixels[i])].push_back(cloud.points[i]);
  return *std::max_element(parts.begin(), parts.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

/// Takes planes out that span more than the body could; what else happens to lie on the plane of a flat body
/// does not make that a background.
void removePlanes(double diameter_m, Cloud* cloud) {
  std::vector<int> open;
  for (std::size_t i = 0; i < cloud->points.size(); ++i)
    if (cloud->free[i]) open.push_back(static_cast<int>(i));
  std::mt19937 random(1);
  for (int k = 0; k < kMostPlanes; ++k) {
    const std::vector<int> plane = largestPlane(*cloud, open, &random);
    if (plane.empty()) return;
    const bool background = spread(largestPart(*cloud, plane)) >= kPlaneBeyondBody * diameter_m;
    for (int i : plane) cloud->free[i] = !background;
    std::vector<int> rest;
    std::set_difference(open.begin(), open.end(), plane.begin(), plane.end(), std::back_inserter(rest));
    open = std::move(rest);
  }
}

/// The free points connected with one of them, taken out of the cloud.
std::vector<Eigen::Vector3d> takePiece(int seed, double step_m, Cloud* cloud) {
  const cv::Rect inside(cv::Point(), cloud->index.size());
  std::vector<Eigen::Vector3d> piece;
  std::vector<int> open{seed};
  cloud->free[seed] = false;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    piece.push_back(cloud->points[i]);
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const cv::Point next = cloud->pixels[i] + cv::Point(du, dv);
        const int j = inside.contains(next) ? cloud->index(next) : -1;
        if (j < 0 || !cloud->free[j] || std::abs(cloud->points[j].z() - cloud->points[i].z()) > step_m)
          continue;
        cloud->free[j] = false;
        open.push_back(j);
      }
    }
  }
  return piece;
}

/// Pieces of about the body's size, the likelier the lower rated.
void addPieces(Cloud cloud, double step_m, double diameter_m,
               std::vector<std::pair<double, ObjectCandidate>>* rated) {
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!cloud.free[i]) continue;
    const std::vector<Eigen::Vector3d> piece = takePiece(static_cast<int>(i), step_m, &cloud);
    const double share = spread(piece) / diameter_m;
    if (static_cast<int>(piece.size()) < kFewestPixels || share < kSmallestShare || share > kLargestShare)
      continue;
    ObjectCandidate candidate{Eigen::Vector3d::Zero(), static_cast<int>(piece.size())};
    for (const Eigen::Vector3d& p : piece) candidate.center += p / static_cast<double>(piece.size());
    // A body that somebody wants tracked is rather near than far.
    rated->emplace_back(2.0 * std::abs(std::log(share / kLikelyShare)) - std::log(candidate.pixels),
                        candidate);
  }
}

}  // namespace

std::vector<ObjectCandidate> findObjectCandidates(const RgbdFrame& frame, const ColorModel& colors,
                                                  double diameter_m) {
  Cloud cloud = makeCloud(frame, colors);
  removePlanes(diameter_m, &cloud);
  std::vector<std::pair<double, ObjectCandidate>> rated;
  double last_step_m = 0.0;
  for (const double step : kSteps) {
    const double step_m = std::max(kSmallestStep, step * diameter_m);
    if (step_m > last_step_m) addPieces(cloud, step_m, diameter_m, &rated);
    last_step_m = step_m;
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ObjectCandidate> candidates;
  for (const auto& entry : rated) {
    const ObjectCandidate& candidate = entry.second;
    const bool is_new = std::none_of(candidates.begin(), candidates.end(), [&](const ObjectCandidate& other) {
      return (other.center - candidate.center).norm() < kSamePlace * diameter_m;
    });
    if (is_new) candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace softbody
