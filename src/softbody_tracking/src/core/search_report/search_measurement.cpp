#include "search_report/search_measurement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "agreement/acceptance.h"
#include "agreement/body_edges.h"
#include "agreement/confinement.h"
#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"
#include "registration/body_candidates.h"
#include "registration/coarse_to_fine_search.h"
#include "registration/search_anywhere.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

// Factors between units: m, cm, mm and inch of a mesh; 0.1, 0.25 and 1 mm of depth.
constexpr double kUnits[] = {0.001, 0.01, 0.0254, 0.1, 0.25, 4.0, 10.0, 1.0 / 0.0254, 100.0, 1000.0};

Eigen::Vector3d sidesOf(const Points& vertices) {
  Eigen::Vector3d sides = vertices.colwise().maxCoeff() - vertices.colwise().minCoeff();
  std::sort(sides.data(), sides.data() + 3, std::greater<>());
  return sides;
}

void measureDepth(const RgbdFrame& frame, SearchReport* report) {
  int measured = 0;
  double nearest = std::numeric_limits<double>::max();
  for (const float z : frame.depth) {
    if (!(z > 0.0f)) continue;
    ++measured;
    nearest = std::min<double>(nearest, z);
    report->farthest_m = std::max<double>(report->farthest_m, z);
  }
  if (measured > 0) report->nearest_m = nearest;
  if (measured >= kFewestPixels) report->depth_share = measured / static_cast<double>(frame.depth.total());
}

/// A posed mesh in the image of the parts.
RasterImage rendered(const RgbdFrame& image, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  RasterImage result;
  rasterize(image.camera, transformed(mesh.vertices, pose), mesh.triangles, &result);
  return result;
}

/// What the camera sees of it.
std::vector<Eigen::Vector3d> visiblePoints(const RgbdFrame& image, const RasterImage& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (int v = mesh.region.y; v < mesh.region.br().y; ++v)
    for (int u = mesh.region.x; u < mesh.region.br().x; ++u)
      if (mesh.triangle(v, u) >= 0) points.push_back(image.camera.unproject(u, v, mesh.depth(v, u)));
  return points;
}

/// Pixels that a part shares with a mesh, as a share of those that either has.
double overlap(const DepthPart& part, const RasterImage& mesh) {
  const int columns = mesh.triangle.cols;
  int shared = 0, covered = 0;
  for (const int pixel : part.pixels) shared += mesh.triangle(pixel / columns, pixel % columns) >= 0 ? 1 : 0;
  for (int v = mesh.region.y; v < mesh.region.br().y; ++v)
    for (int u = mesh.region.x; u < mesh.region.br().x; ++u) covered += mesh.triangle(v, u) >= 0 ? 1 : 0;
  return static_cast<double>(shared) / std::max<double>(1.0, covered + part.candidate.pixels - shared);
}

/// The part that a mesh covers best; without a mesh, the likeliest one. nullptr without parts.
const DepthPart* partAt(const std::vector<DepthPart>& parts, const std::optional<RasterImage>& mesh) {
  const auto badness = [&](const DepthPart& part) { return mesh ? -overlap(part, *mesh) : part.rating; };
  const auto best = std::min_element(parts.begin(), parts.end(),
                                     [&](const auto& a, const auto& b) { return badness(a) < badness(b); });
  return best == parts.end() ? nullptr : &*best;
}

/// Share of a mesh's pixels at which something is nearer that does not belong to the part.
double hiddenShare(const RgbdFrame& image, const RasterImage& mesh, const DepthPart& part) {
  cv::Mat1b own(mesh.triangle.size(), 0);
  for (const int pixel : part.pixels) own(pixel / own.cols, pixel % own.cols) = 1;
  int covered = 0, hidden = 0;
  for (int v = mesh.region.y; v < mesh.region.br().y; ++v) {
    for (int u = mesh.region.x; u < mesh.region.br().x; ++u) {
      if (mesh.triangle(v, u) < 0) continue;
      ++covered;
      const double measured = image.depth(v, u), expected = mesh.depth(v, u);
      if (measured > 0.0 && measured < expected - distanceScaleAt(expected) && own(v, u) == 0) ++hidden;
    }
  }
  return static_cast<double>(hidden) / std::max(1, covered);
}

void measurePose(const RgbdFrame& frame, const SearchMeshes& meshes, const PoseHypothesis& best,
                 const std::optional<RoughPose>& rough, SearchReport* report) {
  report->pose = best.pose;
  const RgbdFrame image = subsampled(frame, kLargeColumns);
  const PoseAgreement seen = PoseCost(image, meshes.fine).agreement(best.pose);
  const double covered = std::max(1, seen.covered);
  report->cost = rough ? seen.misfit : freeCost(frame, meshes.fine, best.pose);
  report->agreeing = seen.agreeing / covered;
  report->nearer = seen.nearer / covered;
  report->farther = seen.farther / covered;
  report->difference_m = seen.difference_m;
  report->continuing = seen.continuing / std::max(1, seen.outline);
  report->confined = confinement(frame, meshes.fine, best.pose);
  report->without_edge = shareWithoutEdge(frame, meshes.fine, best.pose);
  report->near_pose = rough.has_value();
  if (!rough) return;
  const Eigen::Vector3d center = meshes.full.vertices.colwise().mean();
  const PoseDeviation off = deviationFrom(*rough, best.pose, center);
  report->outside = !isNear(*rough, best.pose, center);
  report->shift_m = off.shift * rough->std_m;
  report->turn_rad = off.turn * rough->std_rad;
}

/// The same mesh, larger about the origin of the rest frame.
TriangleMesh scaled(const TriangleMesh& mesh, double factor) {
  return {factor * mesh.vertices, mesh.triangles};
}

/// Width of the view at the farthest depth [m].
double widestView(const RgbdFrame& image) {
  float farthest = 0.0f;
  for (const float z : image.depth)
    if (z > farthest) farthest = z;
  return farthest * image.camera.width / image.camera.fx;
}

/// The factors with which the body would have the size of a part of the image, the likeliest first.
std::vector<double> likelyUnits(const RgbdFrame& frame, const RegionColors& colors, double diameter_m) {
  const RgbdFrame image = subsampled(frame, kMediumColumns);
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
    if (factors.size() < kKept) factors.push_back(unit.second);
  return factors;
}

/// Whether the image shows the whole outline of a posed mesh. A wall that fills the image fits any large
/// mesh.
bool isWhollyInView(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  const RgbdFrame image = subsampled(frame, kMediumColumns);
  const cv::Rect region = rendered(image, mesh, pose).region;
  const cv::Rect inner(1, 1, image.depth.cols - 2, image.depth.rows - 2);
  return (region & inner) == region && region.area() >= kFewestPixels;
}

/// Whether the image shows edges all around a posed mesh.
bool isBounded(const RgbdFrame& frame, const TriangleMesh& mesh, const Eigen::Isometry3d& pose) {
  return isWhollyInView(frame, mesh, pose) && standsFree(frame, mesh, pose);
}

/// Size of the part at a pose, divided by that of the mesh there. Empty if they are alike, or the part is not
/// wholly in view.
std::optional<double> sizeRatio(const RgbdFrame& frame, const RegionColors& colors,
                                const SearchMeshes& meshes, const PoseHypothesis& best) {
  const RgbdFrame image = subsampled(frame, kMediumColumns);
  const RasterImage mesh = rendered(image, meshes.fine, best.pose);
  const std::vector<Eigen::Vector3d> visible = visiblePoints(image, mesh);
  const std::vector<DepthPart> parts = findDepthParts(image, colors, meshes.diameter_m);
  const DepthPart* part = visible.empty() ? nullptr : partAt(parts, mesh);
  if (part == nullptr || part->at_border) return std::nullopt;
  const double spread_m = spreadOf(visible), pixel_m = part->candidate.center.z() / image.camera.fx;
  // A pixel at each side shows no difference.
  if (std::abs(part->spread_m - spread_m) < 2.0 * pixel_m) return std::nullopt;
  return part->spread_m / spread_m;
}

}  // namespace

SearchReport measureSearch(const RgbdFrame& frame, const RegionColors& colors, const SearchMeshes& meshes,
                           const SearchOutcome& outcome, const std::optional<RoughPose>& rough) {
  const std::optional<PoseHypothesis>& best = outcome.best;
  SearchReport report;
  report.pictured = outcome.refused.tried;
  report.refused_by_depth = outcome.refused.by_depth;
  report.refused_by_picture = outcome.refused.by_picture;
  report.several_places = outcome.refused.several;
  report.body_m = sidesOf(meshes.full.vertices);
  const RgbdFrame image = subsampled(frame, kMediumColumns);
  measureDepth(image, &report);
  std::optional<RasterImage> mesh;
  if (best) {
    measurePose(frame, meshes, *best, rough, &report);
    mesh = rendered(image, meshes.fine, best->pose);
  }
  const std::vector<DepthPart> parts = findDepthParts(image, colors, meshes.diameter_m);
  if (const DepthPart* part = partAt(parts, mesh)) {
    report.part_m = part->size_m;
    report.part_distance_m = part->candidate.center.norm();
    report.part_fits = part->fits;
    report.part_at_border = part->at_border;
    if (mesh) report.hidden = hiddenShare(image, *mesh, *part);
  }
  return report;
}

std::optional<double> fittingScale(const RgbdFrame& frame, const RegionColors& colors,
                                   const SearchMeshes& meshes, const std::optional<PoseHypothesis>& best) {
  std::vector<double> factors = likelyUnits(frame, colors, meshes.diameter_m);
  if (best) {
    const std::optional<double> ratio = sizeRatio(frame, colors, meshes, *best);
    if (ratio) factors.push_back(*ratio);
  }
  std::optional<double> fitting;
  double highest_cost = kLargestCost;
  for (const double factor : factors) {
    const SearchMeshes other = makeSearchMeshes(scaled(meshes.full, factor));
    for (const PoseHypothesis& pose : posesAnywhere(frame, colors, other, {})) {
      if (pose.cost > highest_cost || !isBounded(frame, other.fine, pose.pose)) continue;
      fitting = factor;
      highest_cost = pose.cost;
    }
  }
  return fitting;
}

}  // namespace softbody
