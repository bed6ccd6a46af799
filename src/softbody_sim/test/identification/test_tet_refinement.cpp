#include <gtest/gtest.h>

#include <random>
#include <set>

#include "fixtures/test_meshes.h"
#include "identification/tet_refinement.h"

namespace softbody {
namespace {

/// A box whose vertices are shaken.
TetTopology shakenBox(unsigned seed) {
  std::mt19937 random(seed);
  TetTopology box = testing::boxTopology({3, 2, 2}, {0.09, 0.06, 0.06});
  box.rest_vertices += testing::randomPoints(box.rest_vertices.rows(), 0.003, &random);
  return box;
}

TEST(TetRefinement, KeepsVolumeAndBoundary) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const TetTopology box = shakenBox(seed);
    const RefinedTets fine = refine(box);
    EXPECT_EQ(fine.topology.tets.rows(), 8 * box.tets.rows());
    EXPECT_EQ(fine.topology.surface.rows(), 4 * box.surface.rows());
    const Eigen::VectorXd volumes = tetVolumes(fine.topology.rest_vertices, fine.topology.tets);
    EXPECT_GT(volumes.minCoeff(), 0.0);
    const double volume = tetVolumes(box.rest_vertices, box.tets).sum();
    EXPECT_NEAR(volumes.sum(), volume, 1e-12 * volume);
    EXPECT_NEAR(enclosedVolume(fine.topology.rest_vertices, fine.topology.surface), volume, 1e-12 * volume);
    // Eight tets of the same volume each.
    const Eigen::VectorXd before = tetVolumes(box.rest_vertices, box.tets);
    for (Eigen::Index t = 0; t < volumes.size(); ++t) EXPECT_NEAR(volumes[t], before[t / 8] / 8.0, 1e-15);
  }
}

TEST(TetRefinement, FacesFitTogether) {
  const RefinedTets fine = refine(shakenBox(3));
  EXPECT_TRUE(isClosed(fine.topology.surface));
  EXPECT_EQ(tetPieces(fine.topology.tets, static_cast<int>(fine.topology.rest_vertices.rows())),
            std::vector<std::uint32_t>(static_cast<std::size_t>(fine.topology.tets.rows()), 0u));
}

TEST(TetRefinement, TheSameProblemIsOnTheFineMesh) {
  MaterialProblem problem;
  problem.topology = shakenBox(5);
  const Points& rest = problem.topology.rest_vertices;
  ShapeObservation observation;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.05, 0.35);
  for (int k = 0; k < 50; ++k) {
    const double a = uniform(random), b = uniform(random), c = uniform(random);
    Target target;
    target.place = {k, {a, b, c, 1.0 - a - b - c}};
    target.position = positionOf(target.place, rest, problem.topology.tets);
    observation.targets.push_back(target);
  }
  for (int v = 0; v < 9; ++v) observation.surroundings.pins.push_back({v, rest.row(v)});
  observation.surroundings.loads = Points::Zero(rest.rows(), 3);
  observation.surroundings.loads.bottomRows(9).rowwise() = Eigen::RowVector3d(0.1, -0.2, 0.3);
  observation.wrenches.resize(1);
  observation.wrenches[0].vertices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  problem.observations = {observation};
  const MaterialProblem fine = refine(problem);
  const Points& fine_rest = fine.topology.rest_vertices;
  const ShapeObservation& refined = fine.observations.at(0);
  for (const Target& target : refined.targets)
    EXPECT_LT((positionOf(target.place, fine_rest, fine.topology.tets) - target.position).norm(), 1e-12);
  EXPECT_GT(refined.surroundings.pins.size(), 20u);
  std::set<int> pinned;
  for (const Pin& pin : refined.surroundings.pins) {
    EXPECT_LT((fine_rest.row(pin.vertex).transpose() - pin.position).norm(), 1e-12);
    pinned.insert(pin.vertex);
  }
  EXPECT_EQ(std::vector<int>(pinned.begin(), pinned.end()), refined.wrenches.at(0).vertices);
  EXPECT_LT(
      (refined.surroundings.loads.colwise().sum() - observation.surroundings.loads.colwise().sum()).norm(),
      1e-12);
}

}  // namespace
}  // namespace softbody
