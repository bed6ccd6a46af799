#include "corpus/mesh_checks.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include "report/model_trial.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody::test {
namespace {

constexpr double kMostSeconds = 10.0, kMostVolumeError = 0.05, kMostCutError = 1e-3;

/// @return what is wrong with a plane's cut, or nothing.
std::string cutFault(const ObjectModel& model, unsigned seed) {
  const CuttableBody surface(model.visual, model.volume);
  const Points& rest = model.visual.rest_vertices;
  const double whole = enclosedVolume(rest, model.visual.triangles);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d direction(normal(random), normal(random), normal(random));
    const Eigen::Vector3d point = 0.5 * (rest.row(static_cast<Eigen::Index>(random() % rest.rows())) +
                                         rest.row(static_cast<Eigen::Index>(random() % rest.rows())));
    const CutPreview cut = surface.preview(planePatch(point, direction, rest));
    if (!cut.refusal.empty())
      return fmt::format("called good, but the plane at ({:.4g}, {:.4g}, {:.4g}) does not cut: {}", point[0],
                         point[1], point[2], cut.refusal);
    if (std::abs(std::accumulate(cut.volumes.begin(), cut.volumes.end(), -whole)) > kMostCutError * whole)
      return "called good, but the pieces of a cut differ from the whole";
  }
  return "";
}

std::string faultOf(const MutatedMesh& mesh, const ObjectModel& model, Verdict verdict, unsigned seed) {
  const double volume = enclosedVolume(model.visual.rest_vertices, model.visual.triangles);
  if (!mesh.volume) return "it should have been refused: it does not say which body is meant";
  if (std::abs(volume - *mesh.volume) > kMostVolumeError * *mesh.volume)
    return fmt::format("volume {:.4g} instead of {:.4g} cm3", 1e6 * volume, 1e6 * *mesh.volume);
  return verdict == Verdict::kGood ? cutFault(model, seed) : "";
}

}  // namespace

CheckedMesh checkMesh(const MutatedMesh& mesh, const std::string& scratch, unsigned seed) {
  CheckedMesh checked;
  const auto begin = std::chrono::steady_clock::now();
  const auto secondsSoFar = [&begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  try {
    ObjectDescription description;
    description.visual_mesh = scratch + "/mesh.obj";
    description.unit_m = mesh.unit_m;
    writeObj(description.visual_mesh, mesh.mesh);
    VolumeSettings settings;
    settings.use_cache = false;
    const ObjectModel model = buildObjectModel(description, settings);
    const Verdict verdict = worst(judgementsOf(model, measureModel(model)));
    checked.seconds = secondsSoFar();
    checked.outcome = nameOf(verdict);
    checked.volume = enclosedVolume(model.visual.rest_vertices, model.visual.triangles);
    checked.fault = faultOf(mesh, model, verdict, seed);
  } catch (const std::exception& error) {
    checked.seconds = secondsSoFar();
    checked.outcome = fmt::format("refused: {}", error.what());
    if (mesh.volume) checked.fault = "refused";
  }
  if (checked.seconds > kMostSeconds) checked.fault = fmt::format("it took {:.1f} s", checked.seconds);
  return checked;
}

}  // namespace softbody::test
