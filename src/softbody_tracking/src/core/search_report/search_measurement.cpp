#include "search_report/search_measurement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "registration/body_candidates.h"
#include "registration/body_edges.h"
#include "registration/pose_cost.h"
#include "registration/pose_refinement.h"
#include "registration/search_anywhere.h"
#include "registration/subsampled_frame.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

// Columns of the images: those of the search, for parts and for the last step.
constexpr int kPartColumns = 160, kCostColumns = 320;
// First steps of the search with a scaled mesh: its centre may move by a fraction of the body.
constexpr PoseRefinement::Steps kScaledSteps{0.1, 0.02};
// A scale fits much better if it leaves at most this share of the cost; two causes could explain less.
constexpr double kMuchBetter = 0.5;
// Smallest change of scale that a part's size shows: a pixel at each side of a hundred.
constexpr double kSmallestChange = 0.03;
// Factors between units: m, cm, mm and inch of a mesh; 0.1, 0.25 and 1 mm of depth.
constexpr double kUnits[] = {0.001, 0.01, 0.0254, 0.1, 0.25, 4.0, 10.0, 1.0 / 0.0254, 100.0, 1000.0};
// Units that are tried with a whole search.
constexpr std::size_t kTriedUnits = 4;

Eigen::Vector3d sidesOf(const Points& vertices) {
  Eigen::Vector3d sides = vertices.colwise().maxCoeff() - vertices.colwise().minCoeff();
  std::sort(sides.data(), sides.data() + 3, std::greater<>());
  return sides;
}

void measureDepth(const RgbdFrame& frame, SearchReport* report) {
  int measured = 0;
  double nearest = std::numeric_limits<double>::max();
  for (const float z : frame.depth) {
    if (z <= 0.0f) continue;
    ++measured;
    nearest = std::min<double>(nearest, z);
    report->farthest_m = std::max<double>(report->farthest_m, z);
  }
  if (measured > 0) report->nearest_m = nearest;
  report->depth_share = frame.depth.empty() ? 0.0 : measured / static_cast<double>(frame.depth.total());
}

/// What the camera sees of a posed mesh.
std::vector<Eigen::Vector3d> visiblePoints(const RgbdFrame& frame, const TriangleMesh& mesh,
                                           const Eigen::Isometry3d& pose) {
  RasterImage image;
  rasterize(frame.camera, transformed(mesh.vertices, pose), mesh.triangles, &image);
  std::vector<Eigen::Vector3d> points;
  for (int v = image.region.y; v < image.region.br().y; ++v)
    for (int u = image.region.x; u < image.region.br().x; ++u)
      if (image.triangle(v, u) >= 0) points.push_back(frame.camera.unproject(u, v, image.depth(v, u)));
  return points;
}

/// The part at a place; without a place, the likeliest one. nullptr: there is none.
const DepthPart* partAt(const std::vector<DepthPart>& parts, const std::optional<Eigen::Vector3d>& place) {
  const auto badness = [&](const DepthPart& part) {
    return place ? (part.candidate.center - *place).norm() : part.rating;
  };
  const auto best = std::min_element(parts.begin(), parts.end(),
                                     [&](const auto& a, const auto& b) { return badness(a) < badness(b); });
  return best == parts.end() ? nullptr : &*best;
}

Eigen::Vector3d meanOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  return mean;
}

void measurePose(const RgbdFrame& frame, const SearchMeshes& meshes, const PoseHypothesis& best,
                 double distance_scale_m, SearchReport* report) {
  report->pose = best.pose;
  report->cost = best.cost;
  const RgbdFrame image = subsampled(frame, kCostColumns);
  const PoseAgreement seen = PoseCost(image, meshes.full, distance_scale_m).agreement(best.pose);
  const double covered = std::max(1, seen.covered);
  report->agreeing = seen.agreeing / covered;
  report->nearer = seen.nearer / covered;
  report->farther = seen.farther / covered;
  report->difference_m = seen.difference_m;
  report->continuing = static_cast<double>(seen.continuing) / std::max(1, seen.outline);
  report->without_edge = shareWithoutEdge(frame, meshes.full, best.pose, distance_scale_m);
}

/// The same mesh, larger about the origin of the rest frame.
TriangleMesh scaled(const TriangleMesh& mesh, double factor) {
  return {factor * mesh.vertices, mesh.triangles};
}

/// Width of the view at the farthest depth [m].
double widestView(const RgbdFrame& image) {
  const float farthest = *std::max_element(image.depth.begin(), image.depth.end());
  return farthest * image.camera.width / image.camera.fx;
}

/// The factors with which the body would have the size of a part of the image, the likeliest first.
std::vector<double> likelyUnits(const RgbdFrame& frame, const ColorModel& colors, double diameter_m) {
  const RgbdFrame image = subsampled(frame, kPartColumns);
  const double widest_m = widestView(image);
  std::vector<std::pair<double, double>> units;  // difference in size, factor
  for (const double factor : kUnits) {
    const double size_m = factor * diameter_m;
    if (size_m > widest_m) continue;
    double difference = std::numeric_limits<double>::max();
    for (const DepthPart& part : findDepthParts(image, colors, size_m))
      if (part.fits) difference = std::min(difference, part.rating + std::log(part.candidate.pixels));
    if (difference < std::numeric_limits<double>::max()) units.emplace_back(difference, factor);
  }
  std::sort(units.begin(), units.end());
  std::vector<double> factors;
  for (const auto& unit : units)
    if (factors.size() < kTriedUnits) factors.push_back(unit.second);
  return factors;
}

/// Whether the image shows the whole outline of a posed mesh. A wall that fills the image fits any large
/// mesh.
bool isWhollyInView(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const RgbdFrame image = subsampled(frame, kPartColumns);
  RasterImage rendered;
  rasterize(image.camera, transformed(mesh.vertices, pose), mesh.triangles, &rendered);
  const cv::Rect inner(1, 1, image.depth.cols - 2, image.depth.rows - 2);
  return (rendered.region & inner) == rendered.region && rendered.region.area() >= kFewestPixels;
}

bool fitsMuchBetter(double cost, double best_cost, const RegistrationConfig& config) {
  return cost <= config.max_cost && cost <= kMuchBetter * best_cost;
}

}  // namespace

SearchReport measureSearch(const RgbdFrame& frame, const ColorModel& colors, const SearchMeshes& meshes,
                           const std::optional<PoseHypothesis>& best, const RegistrationConfig& config) {
  SearchReport report;
  report.body_m = sidesOf(meshes.full.vertices);
  report.largest_cost = config.max_cost;
  report.largest_without_edge = kLargestShareWithoutEdge;
  const RgbdFrame image = subsampled(frame, kPartColumns);
  measureDepth(image, &report);
  std::optional<Eigen::Vector3d> place;
  if (best) {
    measurePose(frame, meshes, *best, config.distance_scale_m, &report);
    const std::vector<Eigen::Vector3d> visible = visiblePoints(image, meshes.full, best->pose);
    if (!visible.empty()) place = meanOf(visible);
  }
  const std::vector<DepthPart> parts = findDepthParts(image, colors, meshes.diameter_m);
  if (const DepthPart* part = partAt(parts, place)) {
    report.part_m = part->size_m;
    report.part_distance_m = part->candidate.center.norm();
    report.part_fits = part->fits;
    report.part_at_border = part->at_border;
  }
  return report;
}

std::optional<double> fittingScaleNear(const RgbdFrame& frame, const ColorModel& colors,
                                       const SearchMeshes& meshes, const PoseHypothesis& best,
                                       const RegistrationConfig& config) {
  const RgbdFrame image = subsampled(frame, kPartColumns);
  const std::vector<Eigen::Vector3d> visible = visiblePoints(image, meshes.full, best.pose);
  const std::vector<DepthPart> parts = findDepthParts(image, colors, meshes.diameter_m);
  const DepthPart* part = visible.empty() ? nullptr : partAt(parts, meanOf(visible));
  if (part == nullptr || part->at_border) return std::nullopt;
  const double factor = part->spread_m / spreadOf(visible);
  if (!(std::abs(std::log(factor)) > kSmallestChange)) return std::nullopt;
  const TriangleMesh mesh = scaled(meshes.full, factor);
  const RgbdFrame large = subsampled(frame, kCostColumns);
  PoseRefinement refinement(large, mesh, config.distance_scale_m, std::nullopt);
  Eigen::Isometry3d start = best.pose;  // with the body's centre where it was
  start.translation() +=
      (1.0 - factor) * (best.pose.linear() * meshes.full.vertices.colwise().mean().transpose());
  const double cost = refinement.patternSearch(start, kScaledSteps).cost;
  if (!fitsMuchBetter(cost, best.cost, config)) return std::nullopt;
  return factor;
}

std::optional<double> fittingUnit(const RgbdFrame& frame, const ColorModel& colors,
                                  const SearchMeshes& meshes, const RegistrationConfig& config) {
  std::optional<double> fitting;
  double lowest_cost = config.max_cost;
  for (const double factor : likelyUnits(frame, colors, meshes.diameter_m)) {
    const SearchMeshes other = makeSearchMeshes(scaled(meshes.full, factor));
    const auto poses = posesAnywhere(frame, colors, other, {}, config.distance_scale_m);
    if (poses.empty() || poses.front().cost > lowest_cost) continue;
    if (!isWhollyInView(frame, other.full, poses.front().pose)) continue;
    if (shareWithoutEdge(frame, other.full, poses.front().pose, config.distance_scale_m) >
        kLargestShareWithoutEdge)
      continue;
    fitting = factor;
    lowest_cost = poses.front().cost;
  }
  return fitting;
}

}  // namespace softbody
