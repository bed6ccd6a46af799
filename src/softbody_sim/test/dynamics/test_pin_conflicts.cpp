#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "cage/volume_maker.h"
#include "constraints/pin_conflict.h"
#include "fixtures/model_files.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::kFrame;
using testing::placing;
using testing::vertexTargets;

constexpr double kAccuracy = 0.001, kNoise = 0.0005;  // [m]

using Offset = std::function<Eigen::Vector3d(double)>;  // over seconds

Offset constant(const Eigen::Vector3d& offset) {
  return [offset](double) { return offset; };
}
Offset sine(const Eigen::Vector3d& amplitude, double hz) {
  return [=](double s) { return Eigen::Vector3d(amplitude * std::sin(2.0 * M_PI * hz * s)); };
}

TetTopology thickSponge() { return boxTopology({10, 5, 2}, {0.2, 0.1, 0.04}); }

/// The soft toy Spot, 0.2 m long, its lowest corner at the origin.
TetTopology doll() {
  Warnings warnings;
  TriangleMesh mesh = readSurfaceFile(test::testData("spot.obj"), &warnings).mesh;
  const Eigen::RowVector3d low = mesh.vertices.colwise().minCoeff();
  mesh.vertices = (mesh.vertices.rowwise() - low).eval();
  mesh.vertices *= 0.2 / mesh.vertices.maxCoeff();
  const TetMesh tets = volumeAround(mesh, 150);
  TetTopology topology;
  topology.rest_vertices = tets.vertices;
  topology.tets = tets.tets;
  topology.surface = boundaryTriangles(tets.tets);
  topology.tet_pieces.assign(static_cast<std::size_t>(tets.tets.rows()), 0);
  return topology;
}

/// What happened while pin and camera disagreed, and how far the body was from rest in the end.
struct Course {
  double reaction_n = 0.0, away_m = 0.0, end_m = 0.0;
};

/// A body at rest in front of a camera, which sees its upper side. Pins hold one end.
class HeldBody {
 public:
  HeldBody(TetTopology topology, double youngs_modulus_pa)
      : topology_(std::move(topology)), targets_(vertexTargets(topology_, topology_.rest_vertices)) {
    material_.youngs_modulus_pa = youngs_modulus_pa;
    const Points normals = vertexNormals(topology_.rest_vertices, topology_.surface);
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
      if (normals(v, 2) > 0.3) seen_.push_back(static_cast<int>(v));
    }
  }

  /// The pins are off by `offset` for some seconds, then right for one more. Every third second the camera
  /// sees nothing.
  Course follow(const Offset& offset, double seconds, unsigned seed) const {
    std::mt19937 random(seed);
    Simulator simulator(topology_, material_, SimulatorConfig());
    simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
    Course course;
    for (int frame = 1; 1e-9 * kFrame * frame < seconds + 1.0; ++frame) {
      const double now = 1e-9 * kFrame * frame;
      const bool conflict = now < seconds, occluded = conflict && frame / 30 % 3 == 2;
      const Surroundings held = pinned(conflict ? offset(now) : Eigen::Vector3d::Zero());
      simulator.step(occluded ? TargetSet() : camera(&random), frame * kFrame, held);
      course.end_m = testing::largestDistance(simulator.state().vertices, topology_.rest_vertices);
      if (!conflict) continue;
      course.away_m = std::max(course.away_m, course.end_m);
      course.reaction_n = std::max(course.reaction_n, reactionOf(simulator));
    }
    return course;
  }

  /// The force that moves the pinned end alone by an offset: the tets beside it take all of the conflict.
  double largestReaction(const Eigen::Vector3d& offset) const {
    SimulatorConfig config;
    config.iterations = 1000;
    Simulator simulator(topology_, material_, config);
    simulator.step(placing(Eigen::Isometry3d::Identity()), 0);
    Surroundings all = pinned(offset, 0.0);
    const std::size_t count = all.pins.size();
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v) {
      if (!isPinned(v)) all.pins.push_back({v, topology_.rest_vertices.row(v)});
    }
    simulator.settle({}, all);
    return reactionOf(simulator, count);
  }

  /// Mean move of the pinned vertices in static equilibrium, and the conflict that is found, both along x.
  std::pair<double, double> settle(double offset_m, double pin_accuracy_m) const {
    Simulator simulator(topology_, material_, SimulatorConfig());
    TargetSet targets = placing(Eigen::Isometry3d::Identity());
    targets.targets = targets_;
    const Surroundings held = pinned({offset_m, 0.0, 0.0}, pin_accuracy_m);
    simulator.settle(targets, held);
    const Points moves = simulator.state().vertices - topology_.rest_vertices;
    double sum = 0.0;
    for (const Pin& pin : held.pins) sum += moves(pin.vertex, 0);
    return {sum / static_cast<double>(held.pins.size()),
            pinConflict(targets.targets, topology_.tets, simulator.state().vertices, held.pins)};
  }

 private:
  bool isPinned(int v) const { return topology_.rest_vertices(v, 0) < 0.03; }

  Surroundings pinned(const Eigen::Vector3d& offset, double accuracy_m = kAccuracy) const {
    Surroundings held;
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v) {
      if (isPinned(v))
        held.pins.push_back({v, topology_.rest_vertices.row(v).transpose() + offset, accuracy_m});
    }
    return held;
  }

  TargetSet camera(std::mt19937* random) const {
    TargetSet set;
    for (int v : seen_) {
      set.targets.push_back(targets_[static_cast<std::size_t>(v)]);
      set.targets.back().position += testing::randomPoints(1, kNoise, random).transpose();
    }
    return set;
  }

  static double reactionOf(const Simulator& simulator) {
    return reactionOf(simulator, simulator.reactions().pins.size());
  }
  static double reactionOf(const Simulator& simulator, std::size_t count) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < count; ++k) force += simulator.reactions().pins[k].force;
    return force.norm();
  }

  TetTopology topology_;
  Material material_;
  std::vector<Target> targets_;  ///< one per vertex, at rest
  std::vector<int> seen_;
};

/// Conflicts of every kind must stay bounded, however stiff the body is: each of them is tried with one of
/// the stiffnesses in turn. @param turn of the first.
void expectBounded(const TetTopology& topology, int turn) {
  constexpr double kModuli_pa[] = {2e3, 2e4, 2e5};
  const auto expect = [&](const Eigen::Vector3d& size, double hz) {
    const double youngs_modulus_pa = kModuli_pa[turn % 3];
    SCOPED_TRACE("E " + std::to_string(youngs_modulus_pa) + " Pa, x " + std::to_string(size.x()) + " m, " +
                 std::to_string(hz) + " Hz");
    const HeldBody body(topology, youngs_modulus_pa);
    const Course course =
        body.follow(hz > 0.0 ? sine(size, hz) : constant(size), 4.0, static_cast<unsigned>(++turn));
    EXPECT_LT(course.reaction_n, body.largestReaction(size));
    // When the camera sees nothing, the free end swings to the pin and at most as far again.
    EXPECT_LT(course.away_m, 2.0 * size.norm() + 2.0 * kNoise);
    EXPECT_LT(course.end_m, 0.003);
  };
  const Eigen::Vector3d aside(0.57, 0.57, -0.57);
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1), aside})
    expect(0.005 * direction, 0.0);
  for (const double hz : {0.3, 1.0, 3.0}) expect(0.02 * aside, hz);
}

TEST(PinConflicts, StayBoundedOnTheSponge) { expectBounded(thickSponge(), 0); }

TEST(PinConflicts, StayBoundedOnTheDoll) { expectBounded(doll(), 1); }

TEST(PinConflicts, EndAtTheMeanWeightedByInverseVariances) {
  const HeldBody body(thickSponge(), 2e4);
  constexpr double kOffset = 0.005;
  for (const double pin_accuracy_m : {0.0005, 0.001, 0.002}) {
    const double pin = 1.0 / (pin_accuracy_m * pin_accuracy_m), camera = 1.0 / (0.001 * 0.001);
    EXPECT_NEAR(body.settle(kOffset, pin_accuracy_m).first, kOffset * pin / (pin + camera), 0.1 * kOffset);
  }
}

TEST(PinConflicts, AreMeasuredWhateverTheWeights) {
  const HeldBody body(thickSponge(), 2e4);
  for (const double accuracy_m : {0.0, 0.0005, 0.001, 0.004}) {
    EXPECT_NEAR(body.settle(0.005, accuracy_m).second, 0.005, 5e-4) << accuracy_m;
    EXPECT_LT(body.settle(0.0, accuracy_m).second, 1e-6) << accuracy_m;
  }
}

/// Pins turned about the middle of the pinned end: the mean offset is zero.
TEST(PinConflicts, CountRotations) {
  const TetTopology topology = thickSponge();
  const Points& rest = topology.rest_vertices;
  const Eigen::Vector3d center(0.01, 0.05, 0.02);
  const Eigen::AngleAxisd turn(0.1, Eigen::Vector3d::UnitZ());
  std::vector<Pin> pins;
  double squares = 0.0;
  for (int v = 0; v < rest.rows(); ++v) {
    if (rest(v, 0) > 0.03) continue;
    const Eigen::Vector3d place = rest.row(v);
    pins.push_back({v, center + turn * (place - center)});
    squares += (pins.back().position - place).squaredNorm();
  }
  const double expected = std::sqrt(squares / static_cast<double>(pins.size()));
  EXPECT_NEAR(pinConflict(vertexTargets(topology, rest), topology.tets, rest, pins), expected,
              0.1 * expected);
}

TEST(PinConflicts, AreNoneWhereTheCameraSeesNothing) {
  const TetTopology topology = thickSponge();
  const Points& rest = topology.rest_vertices;
  std::vector<Target> far, across;
  for (const Target& target : vertexTargets(topology, rest)) {
    if (target.position.x() > 0.1) far.push_back(target);
    across.push_back(target);
    across.back().normal = Eigen::Vector3d::UnitZ();
  }
  const std::vector<Pin> pins{{0, Eigen::Vector3d(rest.row(0)) + Eigen::Vector3d(0.005, 0.0, 0.0)}};
  EXPECT_EQ(pinConflict(far, topology.tets, rest, pins), 0.0);
  EXPECT_LT(pinConflict(across, topology.tets, rest, pins), 1e-9);
  EXPECT_EQ(pinConflict(far, topology.tets, rest, {}), 0.0);
}

}  // namespace
}  // namespace softbody
