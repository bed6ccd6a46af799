#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "core/projective_dynamics.h"
#include "test_meshes.h"

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);

namespace {
std::atomic<long> allocations{0};
}

// Eigen and CHOLMOD allocate by malloc, not by operator new, which itself ends here.
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
extern "C" void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
extern "C" void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}

namespace softbody {
namespace {

TEST(Allocations, AFrameAfterTheFirstMakesNone) {
  const TetTopology topology = testing::sponge();
  StepPotential potential;
  potential.inertia = Eigen::VectorXd::Constant(topology.rest_vertices.rows(), 2.0);
  potential.prediction = topology.rest_vertices;
  potential.loads = Points::Zero(topology.rest_vertices.rows(), 3);
  std::mt19937 random(8);
  for (bool single : {false, true}) {
    for (int history : {0, 5}) {
      ProjectiveDynamicsOptions options;
      options.minimizer = {20, 0.0, history};
      options.single_precision = single;
      ProjectiveDynamics solver(topology, lameParameters(2.0e4, 0.3), options);
      Points x = topology.rest_vertices;
      for (int frame = 0; frame < 12; ++frame) {
        const Points goal = topology.rest_vertices + testing::randomPoints(x.rows(), 0.005, &random);
        potential.targets.set(testing::vertexTargets(topology, goal), topology.tets, 300.0);
        const long before = allocations;
        solver.minimize(potential, &x);
        const long made = allocations - before;
        if (frame == 0) {
          EXPECT_GT(made, 0) << "the count does not count";
        } else {
          EXPECT_EQ(made, 0) << "frame " << frame << ", history " << history << ", single " << single;
        }
      }
    }
  }
}

}  // namespace
}  // namespace softbody
