#include <test_support/gtest.h>

#include <cmath>
#include <limits>

#include "elasticity/tet_materials.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::boxTopology;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Everything with a coordinate between two limits.
MaterialRegion layer(int axis, double from, double to, double youngs_modulus_pa, double poisson_ratio,
                     double density_kg_m3) {
  MaterialRegion region{Eigen::Vector3d::Constant(-kInfinity), Eigen::Vector3d::Constant(kInfinity),
                        youngs_modulus_pa, poisson_ratio, density_kg_m3};
  region.min[axis] = from;
  region.max[axis] = to;
  return region;
}

/// A beam along x that is held at its lower end.
struct HeldBeam {
  HeldBeam(const Eigen::Vector3i& cells, const Eigen::Vector3d& size) : topology(boxTopology(cells, size)) {
    for (int v = 0; v < topology.rest_vertices.rows(); ++v) {
      if (topology.rest_vertices(v, 0) < 1e-9) held.pins.push_back({v, topology.rest_vertices.row(v)});
      if (topology.rest_vertices(v, 0) > size.x() - 1e-9) end.push_back(v);
    }
  }
  /// Settles; @return the mean move of the free end.
  Eigen::RowVector3d settle(const Material& material, const SimulatorConfig& config) {
    simulator = std::make_unique<Simulator>(topology, material, config);
    simulator->step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    simulator->settle({}, held);
    const StepReport& report = simulator->report();
    EXPECT_TRUE(report.converged) << report.residual_n << " of " << report.external_n << " N after "
                                  << report.iterations;
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int v : end) sum += simulator->state().vertices.row(v) - topology.rest_vertices.row(v);
    return sum / static_cast<double>(end.size());
  }

  TetTopology topology;
  Surroundings held;
  std::vector<int> end;
  std::unique_ptr<Simulator> simulator;
};

class MaterialRegions : public ::testing::TestWithParam<SolverKind> {
 protected:
  MaterialRegions() {
    config_.solver = GetParam();
    config_.iterations = 20000;
    config_.tolerance = 1e-4;
  }
  SimulatorConfig config_;
};

TEST_P(MaterialRegions, TwoHalvesInARowAreTwoSpringsInARow) {
  constexpr double kArea = 0.02 * 0.02, kForce = 0.02;
  HeldBeam beam({8, 2, 2}, {0.2, 0.02, 0.02});
  beam.held.loads = Points::Zero(beam.topology.rest_vertices.rows(), 3);
  for (const double ratio : {3.0, 1000.0}) {
    // Without Poisson's ratio the stress is uniform; each vertex of the end carries what its area is loaded
    // with.
    const Material material{1e4, 0.0, 30.0, 0.0, {layer(0, 0.1, kInfinity, ratio * 1e4, 0.0, 30.0)}};
    for (const int v : beam.end) {
      const Eigen::RowVector3d place = beam.topology.rest_vertices.row(v);
      const double sides =
          (std::abs(place.y() - 0.01) < 1e-9 ? 2.0 : 1.0) * (std::abs(place.z() - 0.01) < 1e-9 ? 2.0 : 1.0);
      beam.held.loads(v, 0) = kForce / 16.0 * sides;
    }
    const double stretch = kForce * (0.1 / 1e4 + 0.1 / (ratio * 1e4)) / kArea;
    EXPECT_NEAR(beam.settle(material, config_).x(), stretch, 0.01 * stretch) << ratio;
  }
}

/// A stiff layer at the top and the bottom: bending stiffness is the sum of E I, shear is that of the core.
TEST_P(MaterialRegions, ASandwichBendsAsItsTransformedSection) {
  constexpr double kLength = 0.4, kWidth = 0.02, kHeight = 0.04, kFace = 0.01, kForce = 1e-3;
  constexpr double kYoungFace = 1e6, kYoungCore = 1e5;
  HeldBeam beam({32, 2, 8}, {kLength, kWidth, kHeight});
  beam.held.loads = Points::Zero(beam.topology.rest_vertices.rows(), 3);
  for (const int v : beam.end) beam.held.loads(v, 2) = kForce / static_cast<double>(beam.end.size());
  const Material material{kYoungCore,
                          0.0,
                          30.0,
                          0.0,
                          {layer(2, -kInfinity, kFace, kYoungFace, 0.0, 30.0),
                           layer(2, kHeight - kFace, kInfinity, kYoungFace, 0.0, 30.0)}};
  const double core = kHeight - 2.0 * kFace, all = std::pow(kHeight, 3) - std::pow(core, 3);
  const double bending = kWidth / 12.0 * (kYoungFace * all + kYoungCore * std::pow(core, 3));
  // Faces are stiff, so that the shear stress in the core is even over their middle planes' distance.
  const double lever = kHeight - kFace, shear = 0.5 * kYoungCore * kWidth * lever * lever / core;
  const double expected = kForce * (std::pow(kLength, 3) / (3.0 * bending) + kLength / shear);
  EXPECT_NEAR(beam.settle(material, config_).z(), expected, 0.05 * expected);
}

TEST_P(MaterialRegions, PinsCarryTheWeightOfBoth) {
  HeldBeam beam({8, 2, 2}, {0.2, 0.02, 0.02});
  config_.gravity = {0.0, 0.0, -9.81};
  beam.settle({1e6, 0.3, 30.0, 0.0, {layer(0, 0.15, kInfinity, 1e7, 0.49, 1000.0)}}, config_);
  double carried = 0.0;
  for (const Wrench& pin : beam.simulator->reactions().pins) carried -= pin.force.z();
  const double weight = 9.81 * 0.02 * 0.02 * (0.15 * 30.0 + 0.05 * 1000.0);
  EXPECT_NEAR(carried, weight, 1e-3 * weight);
}

INSTANTIATE_TEST_SUITE_P(Solvers, MaterialRegions,
                         ::testing::Values(SolverKind::kProjectiveDynamics, SolverKind::kFem));

TEST(TetMaterials, TheLastRegionCounts) {
  const TetTopology topology = boxTopology({2, 1, 1}, {0.2, 0.1, 0.1});
  const Material material{1e4,
                          0.2,
                          10.0,
                          0.0,
                          {layer(0, 0.1, kInfinity, 1e5, 0.3, 20.0), layer(0, 0.0, kInfinity, 1e6, 0.4, 40.0),
                           layer(0, 0.1, kInfinity, 1e7, 0.45, 80.0)}};
  const TetMaterials materials = tetMaterials(topology, material, 0.7, {});
  for (Eigen::Index t = 0; t < 12; ++t) {
    EXPECT_EQ(materials.elastic.kindOf(t), t < 6 ? 2 : 3);
    EXPECT_EQ(materials.densities[t], t < 6 ? 40.0 : 80.0);
  }
  EXPECT_EQ(materials.largest_youngs_modulus_pa, 1e7);
  EXPECT_NEAR(materials.mean_youngs_modulus_pa, 5.5e6, 1.0);
  EXPECT_EQ(materials.elastic.kinds[3].smoothing.volume, volumeSmoothing(0.45));
}

TEST(TetMaterials, ARegionWithoutTetsOrOutOfRangeIsRefused) {
  const TetTopology topology = boxTopology({2, 1, 1}, {0.2, 0.1, 0.1});
  const MaterialRegion half = layer(0, 0.1, kInfinity, 1e5, 0.3, 20.0),
                       none = layer(0, 0.5, 0.6, 1e5, 0.3, 20.0);
  EXPECT_TRUE(says(complaint([&] {
                     Simulator(topology, {1e4, 0.2, 10.0, 0.0, {half, none}}, {});
                   }),
                   "region 2 "));
  Simulator simulator(topology, {1e4, 0.2, 10.0, 0.0, {half}}, {});
  EXPECT_THROW(simulator.setMaterial({1e4, 0.2, 10.0, 0.0, {none}}), std::invalid_argument);
  EXPECT_THROW(simulator.setMaterial({1e4, 0.2, 10.0, 0.0, {layer(0, 0.1, kInfinity, 1e5, 0.5, 20.0)}}),
               std::invalid_argument);
  EXPECT_EQ(simulator.material().regions.size(), 1u);
}

}  // namespace
}  // namespace softbody
