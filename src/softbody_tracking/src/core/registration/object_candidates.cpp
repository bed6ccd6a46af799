#include "registration/object_candidates.h"

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
constexpr int kUnmeasuredEdge = 2;              // [px] without depth that may part what hides from the hidden
constexpr double kSteps[] = {0.05, 0.1, 0.15};  // of the body's diameter, between neighbours of one piece
constexpr double kSmallestStep = 0.02;          // [m]
constexpr double kNextStep = 1.01;              // times the last one; less is the same
constexpr double kSamePlace = 0.1;              // of the body's diameter
constexpr double kLikelyShare = 0.8;            // of a body's diameter that one view shows
constexpr int kFewestPixels = 25;
constexpr double kSmallestShare = 0.3, kLargestShare = 1.6;  // of the body's diameter

/// n . x = offset
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;

  static double thickness(const Eigen::Vector3d& p) { return kPlaneThickness * std::max(0.5, p.z() * p.z()); }
  bool holds(const Eigen::Vector3d& p) const { return std::abs(normal.dot(p) - offset) < thickness(p); }
  /// Whether a point lies on it or on the camera's side of it.
  bool reaches(const Eigen::Vector3d& p) const {
    return (offset > 0.0 ? normal.dot(p) - offset : offset - normal.dot(p)) < thickness(p);
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

/// Pixels in which a plane shows or may go on behind what is nearer, with the gaps in depth at its edges.
cv::Mat1b extent(const Cloud& cloud, const Plane& plane) {
  cv::Mat1b reached(cloud.index.size(), 0), grown;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (plane.reaches(cloud.points[i])) reached(cloud.pixels[i]) = 1;
  cv::dilate(reached, grown, cv::Mat(), cv::Point(-1, -1), kUnmeasuredEdge);
  grown.copyTo(reached, cloud.index < 0);
  return reached;
}

/// Of a plane's points the most that hang together in the image, be it behind what hides the plane.
std::vector<Eigen::Vector3d> largestPart(const Cloud& cloud, const Plane& plane,
                                         const std::vector<int>& points) {
  cv::Mat1i labels;
  const int count = cv::connectedComponents(extent(cloud, plane), labels);
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
    const std::optional<Plane> plane = largestPlane(*cloud, open, &random);
    if (!plane) return;
    const auto rest = std::stable_partition(open.begin(), open.end(),
                                            [&](int i) { return plane->holds(cloud->points[i]); });
    const std::vector<int> on_it(open.begin(), rest);
    const bool background = spread(largestPart(*cloud, *plane, on_it)) >= kPlaneBeyondBody * diameter_m;
    for (int i : on_it) cloud->free[i] = !background;
    open.erase(open.begin(), rest);
  }
}

/// A connected piece of about the body's size.
struct Piece {
  ObjectCandidate candidate;
  double rating = 0.0;      ///< the lower the likelier
  std::vector<int> points;  ///< in the cloud
};

/// The free points connected with one of them, which are free no longer.
std::vector<int> takePiece(const Cloud& cloud, int seed, double step_m, std::vector<bool>* free) {
  const cv::Rect inside(cv::Point(), cloud.index.size());
  std::vector<int> piece, open{seed};
  (*free)[seed] = false;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    piece.push_back(i);
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
  return piece;
}

/// Pieces of about the body's size.
void addPieces(const Cloud& cloud, double step_m, double diameter_m, std::vector<Piece>* pieces) {
  std::vector<bool> free = cloud.free;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!free[i]) continue;
    Piece piece;
    piece.points = takePiece(cloud, static_cast<int>(i), step_m, &free);
    std::vector<Eigen::Vector3d> places;
    for (int k : piece.points) places.push_back(cloud.points[k]);
    const double share = spread(places) / diameter_m;
    const int pixels = static_cast<int>(places.size());
    if (pixels < kFewestPixels || share < kSmallestShare || share > kLargestShare) continue;
    piece.candidate = {Eigen::Vector3d::Zero(), pixels};
    for (const Eigen::Vector3d& p : places) piece.candidate.center += p / pixels;
    // A body that somebody wants tracked is rather near than far.
    piece.rating = 2.0 * std::abs(std::log(share / kLikelyShare)) - std::log(pixels);
    pieces->push_back(std::move(piece));
  }
}

/// Whether one holds the other: pieces that end at steps of different sizes are nested or apart.
bool nested(const Piece& a, const Piece& b) {
  const bool a_is_smaller = a.points.size() < b.points.size();
  const std::vector<int>& smaller = (a_is_smaller ? a : b).points;
  const std::vector<int>& larger = (a_is_smaller ? b : a).points;
  return std::find(larger.begin(), larger.end(), smaller.front()) != larger.end();
}

/// One piece of everything that stands apart before a second one of anything, each time the likelier first.
std::vector<Piece> inTurn(std::vector<Piece> pieces) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.rating < b.rating; });
  std::vector<Piece> firsts, others;
  for (Piece& piece : pieces) {
    const bool is_first =
        std::none_of(firsts.begin(), firsts.end(), [&](const Piece& other) { return nested(piece, other); });
    (is_first ? firsts : others).push_back(std::move(piece));
  }
  std::move(others.begin(), others.end(), std::back_inserter(firsts));
  return firsts;
}

}  // namespace

std::vector<ObjectCandidate> findObjectCandidates(const RgbdFrame& frame, const ColorModel& colors,
                                                  double diameter_m) {
  Cloud cloud = makeCloud(frame, colors);
  removePlanes(diameter_m, &cloud);
  std::vector<Piece> pieces;
  double last_step_m = 0.0;
  for (const double step : kSteps) {
    const double step_m = std::max(kSmallestStep, step * diameter_m);
    if (step_m > kNextStep * last_step_m) addPieces(cloud, step_m, diameter_m, &pieces);
    last_step_m = step_m;
  }
  std::vector<ObjectCandidate> candidates;
  for (const Piece& piece : inTurn(std::move(pieces))) {
    const bool is_new = std::none_of(candidates.begin(), candidates.end(), [&](const ObjectCandidate& other) {
      return (other.center - piece.candidate.center).norm() < kSamePlace * diameter_m;
    });
    if (is_new) candidates.push_back(piece.candidate);
  }
  return candidates;
}

}  // namespace softbody
