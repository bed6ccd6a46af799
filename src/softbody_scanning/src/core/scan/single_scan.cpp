#include "scan/single_scan.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scan/contradiction.h"
#include "scan/object_part.h"
#include "softbody_scanning/surface/distance_grid.h"
#include "softbody_scanning/surface/iso_surface.h"
#include "softbody_scanning/surface/remeshing.h"

namespace softbody::scanning {
namespace {

constexpr double kCoarse_m = 4e-3;  // voxels in which the object is looked for
// Depth is measured up to 75 degrees from the normal: in a larger gap lies surface that no view measured.
constexpr double kLargestGap_rad = 150.0 * M_PI / 180.0;
constexpr double kReachSigmas = 3.0;  // of one depth: so far from the surface it still counts
constexpr double kFewestReachVoxels = 3.0;

/// The largest part of the circle round the object without a view [rad].
double largestGap(const std::vector<KeyFrame>& frames, const Eigen::Vector3d& middle) {
  std::vector<double> angles;
  for (const KeyFrame& frame : frames) {
    const Eigen::Vector3d eye = frame.T_camera_model.inverse().translation() - middle;
    angles.push_back(std::atan2(eye.y(), eye.x()));
  }
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * M_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

void requireCircle(const std::vector<KeyFrame>& frames, const Eigen::Vector3d& middle) {
  const double gap = largestGap(frames, middle);
  if (gap <= kLargestGap_rad) return;
  throw std::invalid_argument(fmt::format(
      "too few views: {} of them, and none from {:.0f} degrees of the circle round the object; walk "
      "once round it and keep the sheet in the image",
      frames.size(), gap * 180.0 / M_PI));
}

/// Where the object is, found in coarse voxels.
Eigen::AlignedBox3d findObject(const SingleScan& scan, const Eigen::AlignedBox3d& region) {
  const Volume volume(fusionBox(region, kCoarse_m, scan.depth_std_m), scan.views, scan.inverse_depth_std);
  DistanceGrid solid = solidOf(volume);
  cutBelow(kCoarse_m, &solid);
  const auto object = objectPart(isoSurface(solid), scan.at);
  if (!object)
    throw std::invalid_argument(fmt::format(
        "nothing stands on the table in the space that is looked at, {:.0f} x {:.0f} mm; put the object into "
        "its middle, or make --box larger",
        1e3 * region.sizes().x(), 1e3 * region.sizes().y()));
  const Eigen::AlignedBox3d box = boxOf(*object);
  const Eigen::Vector3d free = (box.min() - region.min()).cwiseMin(region.max() - box.max());
  if (free.head<2>().minCoeff() < 2.0 * kCoarse_m || region.max().z() - box.max().z() < 2.0 * kCoarse_m)
    throw std::invalid_argument(fmt::format(
        "the object reaches the border of the space that is looked at, {:.0f} x {:.0f} x {:.0f} mm; use a "
        "larger sheet or --box, or put things beside the object away",
        1e3 * region.sizes().x(), 1e3 * region.sizes().y(), 1e3 * region.max().z()));
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(3.0 * kCoarse_m);
  return {Eigen::Vector3d(box.min() - margin), Eigen::Vector3d(box.max() + margin)};
}

/// The surface ends a little above the table; its lowest vertices are put down onto it.
void standOnTable(double clear_m, double voxel_m, TriangleMesh* mesh) {
  for (auto p : mesh->vertices.rowwise())
    if (p.z() < clear_m + 0.5 * voxel_m) p.z() = 0.0;
}

}  // namespace

FusionBox fusionBox(const Eigen::AlignedBox3d& box, double voxel_m, double depth_std_m) {
  return {box, voxel_m, std::max(kReachSigmas * depth_std_m, kFewestReachVoxels * voxel_m)};
}

SingleScan prepareScan(const PosedRecording& recording) {
  if (recording.frames.empty()) throw std::invalid_argument("no frame of it can be used");
  SingleScan scan;
  scan.at = recording.at;
  scan.inverse_depth_std = measureInverseDepthNoise(recording.frames);
  scan.views.resize(recording.frames.size());
  tbb::parallel_for(std::size_t{0}, scan.views.size(), [&](std::size_t i) {
    scan.views[i] = makeDepthView(recording.frames[i], scan.inverse_depth_std);
  });
  double square = 0.0;
  for (const KeyFrame& frame : recording.frames) square += frame.T_camera_model.translation().squaredNorm();
  scan.depth_std_m = scan.inverse_depth_std * square / static_cast<double>(recording.frames.size());
  scan.box = findObject(scan, recording.region);
  requireCircle(recording.frames, scan.box.center());
  return scan;
}

RegisteredSurface surfaceOfScan(const SingleScan& scan, double voxel_m) {
  const Volume volume(fusionBox(scan.box, voxel_m, scan.depth_std_m), scan.views, scan.inverse_depth_std);
  const double clear = scan.clear(voxel_m);
  requireOneSurface(volume, 2.0 * clear);
  DistanceGrid solid = solidOf(volume);
  cutBelow(clear, &solid);
  auto object = objectPart(isoSurface(solid), scan.at);
  if (!object) throw std::invalid_argument("the object has no surface that several views agree on");
  standOnTable(clear, voxel_m, &*object);
  RegisteredSurface surface{remeshed(*object, kEdgeVoxels * voxel_m), {}, {}};
  surface.seen = seenOf(volume, surface.mesh, scan.depth_std_m);
  for (Eigen::Index v = 0; v < surface.mesh.vertices.rows(); ++v)
    if (!(surface.mesh.vertices(v, 2) > 0.0)) surface.seen[v] = 0.0f;
  return surface;
}

std::vector<float> seenOf(const Volume& volume, const TriangleMesh& mesh, double depth_std_m) {
  std::vector<float> seen;
  for (const auto& p : mesh.vertices.rowwise()) seen.push_back(volume.seenAround(p.transpose(), depth_std_m));
  return seen;
}

}  // namespace softbody::scanning
