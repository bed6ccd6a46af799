#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/fusion/oriented_points.h"
#include "bench/fusion/poisson_solid.h"
#include "bench/fusion/resources.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_evaluation/models/model_distance.h"
#include "softbody_evaluation/models/model_fit.h"
#include "softbody_scanning/ros/recording_reader.h"
#include "softbody_scanning/scan/scanned_body.h"
#include "softbody_scanning/surface/distance_grid.h"
#include "softbody_scanning/surface/iso_surface.h"
#include "softbody_scanning/surface/mesh_parts.h"
#include "softbody_scanning/surface/remeshing.h"

/// Fuses recordings with signed distances, as scan_model does, and by Poisson reconstruction, and prints a
/// row of a table for each: docs/scanning.md. Both begin with the tangent planes of the views in a box around
/// the object, and end with triangles of one size.
namespace softbody::scanning {
namespace {

constexpr double kMargin_m = 0.012, kEdgeVoxels = 2.0, kReach = 3.0;  // as scan_model
constexpr double kSpacings[] = {1.0, 2.0};                            // of the oriented points [voxels]

/// All that both ways start from.
struct Depth {
  std::vector<RecordedSide> sides;
  FusionBox box;
  double inverse_depth_std = 0.0, depth_std_m = 0.0, clear_m = 0.0;
  bool one_side() const { return sides.size() == 1; }
};

Depth prepare(const std::vector<std::string>& bags) {
  std::vector<PosedRecording> recordings;
  for (const std::string& bag : bags) {
    RecordingOptions options;
    options.bag = bag;
    options.sheet = loadToolDescription(CONFIG_DIR "/sheet.yaml");
    RecordingReport report;
    recordings.push_back(readRecording(
        options, [](double) {}, &report));
  }
  const ScannedBody body = scanBody(recordings, {});
  Depth depth;
  depth.inverse_depth_std = measureInverseDepthNoise(recordings[0].frames);
  depth.depth_std_m = body.depth_std_m;
  depth.clear_m = std::max(body.depth_std_m, body.voxel_m);
  const Eigen::Vector3d low = body.mesh.vertices.colwise().minCoeff(),
                        high = body.mesh.vertices.colwise().maxCoeff();
  depth.box = {{Eigen::Vector3d(low.array() - kMargin_m), Eigen::Vector3d(high.array() + kMargin_m)},
               body.voxel_m,
               kReach * depth.clear_m};
  auto frame = body.frames.begin();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const Eigen::Isometry3d T =
        i == 0 ? Eigen::Isometry3d::Identity() : body.turned[i - 1].registration.T_fixed_moving;
    RecordedSide side{{}, {T.linear().col(2), T.translation()}};
    for (std::size_t k = 0; k < recordings[i].frames.size(); ++k)
      side.views.push_back(makeDepthView(*frame++, depth.inverse_depth_std));
    depth.sides.push_back(std::move(side));
  }
  return depth;
}

Volume fuse(const Depth& depth) {
  std::optional<Volume> all;
  for (const RecordedSide& side : depth.sides) {
    Volume volume(depth.box, side.views, depth.inverse_depth_std);
    if (!depth.one_side()) volume.forgetBelow(side.table, depth.clear_m);
    if (all)
      all->add(volume);
    else
      all.emplace(std::move(volume));
  }
  return *std::move(all);
}

/// The largest part in triangles of one size. One recording alone is cut at the table.
TriangleMesh meshOf(const Depth& depth, DistanceGrid solid) {
  if (depth.one_side()) cutBelow(depth.clear_m, &solid);
  std::vector<TriangleMesh> parts = partsOf(isoSurface(solid));
  if (parts.empty()) throw std::runtime_error("the fusion gave no surface");
  const auto volume = [](const TriangleMesh& mesh) { return enclosedVolume(mesh.vertices, mesh.triangles); };
  TriangleMesh mesh = *std::max_element(parts.begin(), parts.end(),
                                        [&](const auto& a, const auto& b) { return volume(a) < volume(b); });
  if (depth.one_side())
    for (auto p : mesh.vertices.rowwise())
      if (p.z() < depth.clear_m + 0.5 * depth.box.voxel_m) p.z() = 0.0;
  return remeshed(mesh, kEdgeVoxels * depth.box.voxel_m);
}

/// As scan_model's: what lies on the table was not seen.
std::vector<float> seenOf(const TriangleMesh& mesh, const Volume& evidence, const Depth& depth) {
  std::vector<float> seen;
  for (const auto& p : mesh.vertices.rowwise()) {
    const bool below = depth.one_side() && !(p.z() > 0.0);
    seen.push_back(below ? 0.0f : evidence.seenAround(p.transpose(), depth.depth_std_m));
  }
  return seen;
}

void printRow(const std::string& way, const TriangleMesh& mesh, const std::vector<float>& seen,
              const evaluation::Model& truth, const bench::Resources& taken) {
  const evaluation::Model scanned{way, mesh, seen, {}, {}, {}};
  const auto report = evaluation::compareModels(scanned, truth, evaluation::fitModel(scanned, truth), 1);
  const auto cell = [](const evaluation::Summary& s) {
    return fmt::format("{:.2f}, {:.2f}", 1e3 * s.mean, 1e3 * s.p99);
  };
  const double volume =
      report.scanned_m3 && report.true_m3 ? *report.scanned_m3 / *report.true_m3 : std::nan("");
  fmt::print("| {} | {} | {} | {:.3f} | {:.1f} | {:.0f} |\n", way, cell(report.seen->to_truth),
             cell(report.whole.to_scanned), volume, taken.cpu_s, taken.peak_mb);
}

void compare(const std::string& true_mesh, const std::vector<std::string>& bags) {
  std::vector<std::string> warnings;
  const evaluation::Model truth = evaluation::readModel(true_mesh, &warnings);
  const Depth depth = prepare(bags);
  const Volume evidence = fuse(depth);
  fmt::print(
      "| fusion | seen to true: mean, 99 % [mm] | true to all: mean, 99 % [mm] | volume | CPU [s] | memory "
      "[MB] |"
      "\n| --- | --- | --- | --- | --- | --- |\n");
  const auto row = [&](const std::string& way, const auto& fusion) {
    TriangleMesh mesh;
    const bench::Resources taken = bench::measure([&] { mesh = meshOf(depth, fusion()); });
    printRow(way, mesh, seenOf(mesh, evidence, depth), truth, taken);
  };
  row("signed distances", [&] { return solidOf(fuse(depth)); });
  // One recording is cut at the table in the end. Several are not: there all of the table's noise must go.
  const double height_m = depth.one_side() ? depth.clear_m : kReach * depth.clear_m;
  for (const double voxels : kSpacings) {
    const double spacing_m = voxels * depth.box.voxel_m;
    row(fmt::format("Poisson, a point in {:.1f} mm", 1e3 * spacing_m),
        [&] { return poissonSolid(orientedPoints(depth.sides, depth.box, spacing_m, height_m), depth.box); });
  }
}

}  // namespace
}  // namespace softbody::scanning

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fputs("Usage: compare_fusion TRUE_MESH RECORDING.bag [TURNED_OVER.bag ...]\n", stderr);
    return 2;
  }
  softbody::scanning::compare(argv[1], {argv + 2, argv + argc});
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "compare_fusion: %s\n", error.what());
  return 1;
}
