#include "report/model_trial.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "surface_mesh/self_intersection.h"

namespace softbody {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kStretch = 1.1;  ///< at the start: more than a frame brings, far from inversion
constexpr int kSteps = 30;        ///< one second
constexpr Nanoseconds kStep = 33'333'333;
constexpr std::chrono::seconds kMostSimulated{3};  ///< of wall time; then the body is far too slow anyway
constexpr int kMeasuredFrames = 5;                 ///< of the surface; their median ignores a busy moment

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double medianOf(const std::function<void()>& work) {
  std::vector<double> times;
  for (int k = 0; k < kMeasuredFrames; ++k) {
    const Clock::time_point begin = Clock::now();
    work();
    times.push_back(millisecondsSince(begin));
  }
  return median(&times);
}

/// @return the last state.
MeshState simulate(const ObjectModel& model, ModelTrial* trial) {
  Simulator simulator(model.volume, model.material, {});
  TargetSet none;
  none.revision = model.volume.revision;
  none.reset = true;
  Nanoseconds stamp = kStep;
  simulator.step(none, stamp);
  const Points& rest = model.volume.rest_vertices;
  const Eigen::RowVector3d middle = rest.colwise().mean();
  Eigen::Index longest = 0;
  (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff(&longest);
  Points stretched = rest.rowwise() - middle;
  stretched.col(longest) *= kStretch;
  simulator.setVertices(stretched.rowwise() + middle);
  const double start = simulator.elasticEnergy();
  const Clock::time_point begin = Clock::now();
  std::vector<double> times;
  for (int k = 0; k < kSteps && Clock::now() - begin < kMostSimulated; ++k) {
    const Clock::time_point before = Clock::now();
    simulator.stepUnobserved(none, stamp += kStep);
    times.push_back(millisecondsSince(before));
    trial->energy_growth = std::max(trial->energy_growth, simulator.elasticEnergy() / start);
    trial->simulated_s += 1e-9 * static_cast<double>(kStep);
  }
  trial->cost.simulation_ms = median(&times);
  trial->inverted =
      static_cast<int>((tetVolumes(simulator.state().vertices, model.volume.tets).array() <= 0.0).count());
  return simulator.state();
}

/// Positions as a message has them.
std::vector<float> packed(const Points& points) {
  std::vector<float> values(static_cast<std::size_t>(points.size()));
  std::transform(points.data(), points.data() + points.size(), values.begin(),
                 [](double value) { return static_cast<float>(value); });
  return values;
}

void measureFrames(const VisualSurface& surface, const MeshState& state, FrameCost* cost) {
  const Triangles& triangles = surface.topology().triangles;
  std::vector<float> message;
  cost->surface_ms = medianOf([&] {
    const MeshState moved = surface.apply(state);
    message = packed(vertexNormals(moved.vertices, triangles));
    message = packed(moved.vertices);
  });
  const Points& rest = surface.topology().rest_vertices;
  const Eigen::RowVector3d low = rest.colwise().minCoeff(), high = rest.colwise().maxCoeff();
  Points seen = rest.rowwise() - 0.5 * (low + high);
  seen.col(2).array() += 2.0 * (high - low).norm();
  RasterImage image;
  cost->drawing_ms = medianOf([&] {
    rasterize({640, 480, 600.0, 600.0, 319.5, 239.5}, seen, triangles, &image);
  });
}

/// Middle of the box of the piece with most triangles: a plane through it passes through the surface.
Eigen::Vector3d middleOfLargestPiece(const MeshTopology& mesh) {
  std::vector<std::size_t> counts;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const std::size_t piece = mesh.triangle_pieces[static_cast<std::size_t>(f)];
    if (piece >= counts.size()) counts.resize(piece + 1, 0), boxes.resize(piece + 1);
    ++counts[piece];
    for (const int v : mesh.triangles.row(f)) boxes[piece].extend(Eigen::Vector3d(mesh.rest_vertices.row(v)));
  }
  return boxes[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin())]
      .center();
}

void tryCuts(const CuttableBody& surface, const MeshTopology& mesh, ModelTrial* trial) {
  const double whole = enclosedVolume(mesh.rest_vertices, mesh.triangles);
  const Eigen::Vector3d middle = middleOfLargestPiece(mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const CutPreview cut =
        surface.preview(planePatch(middle, Eigen::Vector3d::Unit(axis), mesh.rest_vertices));
    if (!cut.refusal.empty()) {
      trial->refused_cuts.push_back(
          fmt::format("along {} = {:.1f} mm: {}", "xyz"[axis], 1e3 * middle[axis], cut.refusal));
      continue;
    }
    const double sum = std::accumulate(cut.volumes.begin(), cut.volumes.end(), 0.0);
    trial->volume_error = std::max(trial->volume_error, std::abs(sum - whole) / whole);
  }
}

void findCrossings(const MeshTopology& mesh, ModelTrial* trial) {
  const auto crossing = crossingTriangles({mesh.rest_vertices, mesh.triangles});
  trial->crossings = static_cast<int>(crossing.size());
  if (crossing.empty()) return;
  Eigen::AlignedBox3d common(Eigen::Vector3d::Constant(-1e9), Eigen::Vector3d::Constant(1e9));
  for (const Eigen::Index triangle : crossing.front()) {
    Eigen::AlignedBox3d box;
    for (const int v : mesh.triangles.row(triangle)) box.extend(mesh.rest_vertices.row(v).transpose());
    common = common.intersection(box);
  }
  trial->crossing = common.center();
}

}  // namespace

ModelTrial tryModel(const ObjectModel& model) try {
  ModelTrial trial;
  const CuttableBody surface(model.visual, model.volume);
  const MeshState state = simulate(model, &trial);
  measureFrames(surface.surface(), state, &trial.cost);
  findCrossings(model.visual, &trial);
  tryCuts(surface, model.visual, &trial);
  return trial;
} catch (const std::exception& error) {
  ModelTrial trial;
  trial.failure = error.what();
  return trial;
}

}  // namespace softbody
