#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bench/bent_bodies.h"
#include "bench/peers/held_body.h"
#include "bench/peers/mass_springs.h"
#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/dynamics/simulator.h"

/// Hands bend sponge and doll; several simulators follow the same noisy targets, on the upper side alone.
/// Prints for each the mean error of all vertices [mm] and the median time of a step [ms], as JSON.
namespace {

using namespace softbody;
using namespace softbody::bench;

constexpr int kFrames = 60, kIterations = 20;
constexpr double kStep_s = 1.0 / 30.0, kCurvature = 5.0, kNoise_m = 5e-4;

/// Steps under targets, and gives the vertices.
using Method = std::function<Points(const std::vector<Target>& targets, int frame)>;

/// Vertices of the upper side, as material points.
std::vector<MaterialPoint> upperSide(const TetTopology& body) {
  Points normals = Points::Zero(body.rest_vertices.rows(), 3);
  for (const auto& triangle : body.surface.rowwise()) {
    const Eigen::RowVector3d a = body.rest_vertices.row(triangle[0]), b = body.rest_vertices.row(triangle[1]),
                             c = body.rest_vertices.row(triangle[2]);
    for (const int v : triangle) normals.row(v) += (b - a).cross(c - a);
  }
  std::vector<MaterialPoint> places;
  for (int v = 0; v < static_cast<int>(normals.rows()); ++v) {
    if (!(normals(v, 2) > 0.3 * normals.row(v).norm())) continue;
    for (int t = 0; t < static_cast<int>(body.tets.rows()); ++t) {
      const auto corners = body.tets.row(t);
      if (!(corners.array() == v).any()) continue;
      MaterialPoint place;
      place.tet = t;
      for (int k = 0; k < 4; ++k) place.barycentric[k] = corners[k] == v ? 1.0 : 0.0;
      places.push_back(place);
      break;
    }
  }
  return places;
}

std::vector<std::vector<Target>> targetsOf(const TetTopology& body, const std::vector<Points>& truth) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise_m);
  const std::vector<MaterialPoint> places = upperSide(body);
  std::vector<std::vector<Target>> frames;
  for (const Points& x : truth) {
    std::vector<Target>& targets = frames.emplace_back();
    for (const MaterialPoint& place : places) {
      Target target;
      target.place = place;
      target.position = positionOf(place, x, body.tets);
      for (int k = 0; k < 3; ++k) target.position[k] += noise(random);
      targets.push_back(target);
    }
  }
  return frames;
}

Method simulated(const TetTopology& body, const Material& material, const SimulatorConfig& config) {
  const auto simulator = std::make_shared<Simulator>(body, material, config);
  return [simulator, &body](const std::vector<Target>& targets, int frame) -> Points {
    TargetSet set;
    set.reset = frame == 0;
    const Eigen::RowVector3d middle = body.rest_vertices.colwise().mean();
    set.body_pose.translation() << -middle.x(), 0.0, -middle.z();
    set.targets = targets;
    simulator->step(set, static_cast<Nanoseconds>((frame + 1) * kStep_s * 1e9));
    return simulator->state().vertices;
  };
}

Method massSprings(const TetTopology& body, const Points& start, const std::vector<Target>& first) {
  const Material material;
  const double stiffness = SimulatorConfig().target_stiffness * material.youngs_modulus_pa *
                           meanEdgeLength(body.rest_vertices, body.tets);
  const auto springs = std::make_shared<MassSprings>(body, material, first, stiffness, kStep_s);
  springs->place(start);
  return [springs](const std::vector<Target>& targets, int) {
    springs->step(targets, kIterations);
    return springs->vertices();
  };
}

std::string measured(const std::vector<Points>& truth, const std::vector<std::vector<Target>>& frames,
                     const Method& method) {
  std::vector<double> errors, times;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto now = static_cast<std::size_t>(frame);
    const auto begin = std::chrono::steady_clock::now();
    const Points x = method(frames[now], frame);
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    errors.push_back(1e3 * (x - truth[now]).rowwise().norm().mean());
  }
  const double mean = Eigen::Map<Eigen::VectorXd>(errors.data(), kFrames).mean();
  return fmt::format(R"({{"mean_mm": {:.6f}, "median_ms": {:.6f}}})", mean, median(&times));
}

std::string compared(const std::string& name) {
  const TetTopology body = bodyTopology(name);
  const std::vector<Points> truth = heldShapes(body, kCurvature, kFrames);
  const auto frames = targetsOf(body, truth);
  SimulatorConfig ours, plain, fem;
  plain.lbfgs_history = 0;
  plain.strain_smoothing = 0.0;
  plain.volume_smoothing = 0.0;
  fem.solver = SolverKind::kFem;
  fem.load_fade_s = plain.load_fade_s = fem.memory_s = plain.memory_s = 0.0;
  Material rigid;
  rigid.poisson_ratio = 0.0;  // without a volume term, the energy is that of as-rigid-as-possible tets
  const auto row = [&](const std::string& words, const Method& method) {
    return fmt::format(R"("{}": {})", words, measured(truth, frames, method));
  };
  return fmt::format("\"{}\": {{{}, {}, {}, {}, {}}}", name,
                     row("mass-spring", massSprings(body, truth.front(), frames.front())),
                     row("as-rigid-as-possible tets", simulated(body, rigid, plain)),
                     row("plain projective dynamics", simulated(body, Material(), plain)),
                     row("finite elements (Newton)", simulated(body, Material(), fem)),
                     row("ours", simulated(body, Material(), ours)));
}

}  // namespace

int main() {
  fmt::print("{{{}, {}}}\n", compared("sponge"), compared("doll"));
  return 0;
}
