#include "softbody_scanning/output/scanned_model.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <filesystem>

#include "output/scan_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/textured_mesh_file.h"
#include "texture/painted_mesh.h"

namespace softbody::scanning {
namespace {

constexpr double kDepthSigmas = 3.0;  // a frame that shows something else there differs by more

/// Puts the origin into the middle of the bounding box.
void centre(TriangleMesh* mesh) {
  const Eigen::RowVector3d low = mesh->vertices.colwise().minCoeff(),
                           high = mesh->vertices.colwise().maxCoeff();
  mesh->vertices.rowwise() -= 0.5 * (low + high);
}

}  // namespace

std::string sizeAndPlaceOf(const TriangleMesh& mesh) {
  const Eigen::Vector3d low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  const Eigen::Vector3d size = 1e3 * (high - low), middle = 0.5 * (low + high);
  return fmt::format("{:.0f} x {:.0f} x {:.0f} mm at ({:.3f}, {:.3f}, {:.3f}) m", size.x(), size.y(),
                     size.z(), middle.x(), middle.y(), middle.z());
}

std::string reportOf(const CheckedScan& scan) {
  const ScannedBody& body = scan.body;
  std::string lines = fmt::format(
      "the object: {}, {:.1f} cm^3; {:.0f} % of the surface was seen, {:.0f} % of what did not lie on the "
      "table\n",
      sizeAndPlaceOf(body.mesh), 1e6 * enclosedVolume(body.mesh.vertices, body.mesh.triangles),
      1e2 * scan.seen_share, 1e2 * scan.upper_seen_share);
  for (const TurnedRecording& turned : body.turned) {
    lines += fmt::format("{}: lies on the first recording to {:.2f} mm", turned.name,
                         1e3 * turned.registration.distance_m);
    if (turned.registration.ambiguous)
      lines += fmt::format(
          "; warning: another way to turn it over fits nearly as well ({:.2f}, {:.2f}); look at the model",
          turned.registration.misfit, turned.registration.runner_up);
    lines += "\n";
  }
  if (body.turned.empty())
    lines += "the underside was not seen: it is closed flat; record the object turned over, too\n";
  if (scan.left_out > 0)
    lines += fmt::format("{} key frames did not agree with the others and were left out\n", scan.left_out);
  return lines;
}

Verdict writeModel(CheckedScan scan, const std::string& text, const std::string& folder,
                   const std::function<void(double)>& progress, std::ostream& output) {
  namespace fs = std::filesystem;
  const PaintedMesh painted =
      paintMesh(scan.body.mesh, scan.body.frames, {kDepthSigmas * scan.body.depth_std_m + scan.body.voxel_m});
  centre(&scan.body.mesh);
  const StagedFolder staging(folder);
  const std::string mesh = (staging.path() / "scan.obj").string();
  writeTexturedObj(mesh, scan.body.mesh, painted.texture_coordinates, painted.picture);
  const Verdict verdict = prepareModel({mesh}, folder, {0, false, progress}, output);
  replaceFile(fs::path(folder) / "scan.ply", scanPly(scan.body.mesh, scan.body.seen));
  replaceFile(fs::path(folder) / "report/scan.txt", text);
  return verdict;
}

}  // namespace softbody::scanning
