#include "softbody_scanning/scan/scanned_body.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "scan/object_part.h"
#include "softbody_scanning/fusion/volume.h"
#include "softbody_scanning/surface/iso_surface.h"
#include "softbody_scanning/surface/remeshing.h"

namespace softbody::scanning {
namespace {

constexpr double kCoarse_m = 4e-3;    // voxels in which the object is looked for
constexpr double kReachSigmas = 3.0;  // of one depth: so far from the surface it still counts
constexpr double kFewestReachVoxels = 3.0;
constexpr double kEdgeVoxels = 2.0;  // edge of the final triangles

/// The views, and the noise of their depth.
struct Views {
  std::vector<DepthView> views;
  double inverse_depth_std = 0.0;
  double depth_std_m = 0.0;  // at the region
};

Views makeViews(const std::vector<KeyFrame>& frames, const Eigen::Vector3d& middle) {
  Views views;
  views.inverse_depth_std = measureInverseDepthNoise(frames);
  views.views.resize(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    views.views[i] = makeDepthView(frames[i], views.inverse_depth_std);
  });
  double square = 0.0;
  for (const KeyFrame& frame : frames) square += (frame.T_camera_model * middle).squaredNorm();
  views.depth_std_m = views.inverse_depth_std * square / static_cast<double>(frames.size());
  return views;
}

FusionBox boxAround(const Eigen::AlignedBox3d& box, double voxel_m, double depth_std_m) {
  const double reach = std::max(kReachSigmas * depth_std_m, kFewestReachVoxels * voxel_m);
  return {box, voxel_m, reach};
}

/// Where the object is, found in coarse voxels.
Eigen::AlignedBox3d findObject(const Views& views, const Eigen::AlignedBox3d& region) {
  const Volume volume(boxAround(region, kCoarse_m, views.depth_std_m), views.views, views.inverse_depth_std);
  const auto object = objectPart(isoSurface(solidAbove(volume, kCoarse_m)));
  if (!object)
    throw std::invalid_argument(
        "nothing stands on the table in the recording's middle; put the object into the middle of the sheet");
  const Eigen::AlignedBox3d box = boxOf(*object);
  const Eigen::Vector3d free = (box.min() - region.min()).cwiseMin(region.max() - box.max());
  if (free.head<2>().minCoeff() < 2.0 * kCoarse_m || region.max().z() - box.max().z() < 2.0 * kCoarse_m)
    throw std::invalid_argument(
        fmt::format("the object reaches the border of the space that is looked at, {:.0f} x {:.0f} x {:.0f} "
                    "mm; use a larger sheet, or "
                    "put things beside the object away",
                    1e3 * region.sizes().x(), 1e3 * region.sizes().y(), 1e3 * region.max().z()));
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(3.0 * kCoarse_m);
  return {Eigen::Vector3d(box.min() - margin), Eigen::Vector3d(box.max() + margin)};
}

/// The surface ends a little above the table; its lowest vertices are put down onto it.
void standOnTable(double clear_m, double voxel_m, TriangleMesh* mesh) {
  for (auto p : mesh->vertices.rowwise())
    if (p.z() < clear_m + 0.5 * voxel_m) p.z() = 0.0;
}

std::vector<float> seenOf(const Volume& volume, const TriangleMesh& mesh, double depth_std_m) {
  std::vector<float> seen;
  const double one_view = 1.0 / (depth_std_m * depth_std_m);
  for (const auto& p : mesh.vertices.rowwise()) {
    const double views = p.z() > 0.0 ? volume.nearest(p.transpose()).seen / one_view : 0.0;
    seen.push_back(static_cast<float>(std::min(1.0, views)));
  }
  return seen;
}

}  // namespace

ScannedBody scanBody(const std::vector<KeyFrame>& frames, const ScanSettings& settings) {
  if (frames.empty()) throw std::invalid_argument("no frame of the recording can be used");
  settings.progress("prepare depth");
  const Views views = makeViews(frames, {0.0, 0.0, 0.0});
  settings.progress("find the object");
  const Eigen::AlignedBox3d box = findObject(views, settings.region);
  ScannedBody body;
  body.depth_std_m = views.depth_std_m;
  body.voxel_m = settings.voxel_m > 0.0 ? settings.voxel_m : std::max(1e-3, box.diagonal().norm() / 200.0);
  settings.progress("fuse depth");
  const Volume volume(boxAround(box, body.voxel_m, views.depth_std_m), views.views, views.inverse_depth_std);
  settings.progress("make the surface");
  const double clear = std::max(views.depth_std_m, body.voxel_m);
  auto object = objectPart(isoSurface(solidAbove(volume, clear)));
  if (!object) throw std::invalid_argument("the object has no surface that several views agree on");
  standOnTable(clear, body.voxel_m, &*object);
  body.mesh = remeshed(*object, kEdgeVoxels * body.voxel_m);
  body.seen = seenOf(volume, body.mesh, views.depth_std_m);
  return body;
}

}  // namespace softbody::scanning
