#include "softbody_scanning/scan/scanned_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "scan/object_part.h"
#include "scan/single_scan.h"
#include "scan/surface_colors.h"
#include "softbody_scanning/surface/distance_grid.h"
#include "softbody_scanning/surface/iso_surface.h"
#include "softbody_scanning/surface/remeshing.h"

namespace softbody::scanning {
namespace {

// Of one depth: median distance of surfaces that fit together. Each is the mean of many views.
constexpr double kFitSigmas = 0.5;

/// Calls the work and tells of which recording an error is.
template <typename Work>
auto ofRecording(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
}

/// The recording's own surface with colours.
RegisteredSurface roughSurface(const SingleScan& scan, const PosedRecording& recording, double voxel_m) {
  RegisteredSurface surface = surfaceOfScan(scan, voxel_m);
  surface.table.emplace(Eigen::Vector3d::UnitZ(), 0.0);
  surface.colors = surfaceColors(surface.mesh, scan.views, recording.frames, scan.inverse_depth_std);
  return surface;
}

Registration lie(const RegisteredSurface& moving, const RegisteredSurface& fixed, double depth_std_m) {
  const Registration found = registerSurfaces(moving, fixed);
  if (found.distance_m > kFitSigmas * depth_std_m)
    throw std::invalid_argument(
        fmt::format("does not show the same body as the first recording: the surfaces are {:.1f} mm apart; "
                    "record the object "
                    "turned over, and not deformed",
                    1e3 * found.distance_m));
  return found;
}

Eigen::Hyperplane<double, 3> tableOf(const Eigen::Isometry3d& T_model_recording) {
  return {T_model_recording.linear().col(2), T_model_recording.translation()};
}

/// Brings a recording into another model frame.
void moveInto(const Eigen::Isometry3d& T_model_recording, SingleScan* scan, PosedRecording* recording) {
  for (KeyFrame& frame : recording->frames)
    frame.T_camera_model = frame.T_camera_model * T_model_recording.inverse();
  for (DepthView& view : scan->views) view.T_camera_model = view.T_camera_model * T_model_recording.inverse();
}

/// The surface of several recordings. @param T_model_recording of each. @param body gets mesh and seen.
void mergeScans(const std::vector<SingleScan>& scans, const std::vector<Eigen::Isometry3d>& T_model_recording,
                ScannedBody* body) {
  const FusionBox box = fusionBox(scans.front().box, body->voxel_m, body->depth_std_m);
  std::unique_ptr<Volume> all;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    auto volume = std::make_unique<Volume>(box, scans[i].views, scans[i].inverse_depth_std);
    volume->forgetBelow(tableOf(T_model_recording[i]), scans[i].clear(body->voxel_m));
    if (all)
      all->add(*volume);
    else
      all = std::move(volume);
  }
  const auto object = objectPart(isoSurface(solidOf(*all)), scans.front().at);
  if (!object) throw std::invalid_argument("the recordings together show no surface");
  body->mesh = remeshed(*object, kEdgeVoxels * body->voxel_m);
  body->seen = seenOf(*all, body->mesh, body->depth_std_m);
}

}  // namespace

ScannedBody scanBody(std::vector<PosedRecording> recordings, const ScanSettings& settings) {
  std::vector<SingleScan> scans;
  for (const PosedRecording& recording : recordings) {
    settings.progress("find the object in " + recording.name);
    scans.push_back(ofRecording(recording.name, [&] { return prepareScan(recording); }));
  }
  ScannedBody body;
  body.depth_std_m = scans.at(0).depth_std_m;
  body.voxel_m =
      settings.voxel_m > 0.0 ? settings.voxel_m : std::max(1e-3, scans[0].box.diagonal().norm() / 200.0);
  if (scans.size() == 1) {
    settings.progress("make the surface");
    RegisteredSurface surface =
        ofRecording(recordings[0].name, [&] { return surfaceOfScan(scans[0], body.voxel_m); });
    body.mesh = std::move(surface.mesh);
    body.seen = std::move(surface.seen);
  } else {
    std::vector<Eigen::Isometry3d> poses{Eigen::Isometry3d::Identity()};
    const RegisteredSurface first = roughSurface(scans[0], recordings[0], body.voxel_m);
    for (std::size_t i = 1; i < scans.size(); ++i) {
      settings.progress("turn over " + recordings[i].name);
      const Registration found = ofRecording(recordings[i].name, [&] {
        return lie(roughSurface(scans[i], recordings[i], body.voxel_m), first, body.depth_std_m);
      });
      body.turned.push_back({recordings[i].name, found});
      poses.push_back(found.T_fixed_moving);
      moveInto(found.T_fixed_moving, &scans[i], &recordings[i]);
    }
    settings.progress("make the surface");
    mergeScans(scans, poses, &body);
  }
  for (PosedRecording& recording : recordings)
    std::move(recording.frames.begin(), recording.frames.end(), std::back_inserter(body.frames));
  return body;
}

}  // namespace softbody::scanning
