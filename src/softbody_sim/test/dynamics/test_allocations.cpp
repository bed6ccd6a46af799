#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"
#include "time_step/projective_dynamics.h"

extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);

namespace {
std::atomic<long> allocations{0};
}

// Eigen and CHOLMOD call malloc directly; operator new calls it, too.
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
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}

namespace softbody {
namespace {

TEST(Allocations, AFrameAfterTheFirstMakesNone) {
  const TetTopology topology = testing::sponge();
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::Constant(topology.rest_vertices.rows(), 2.0);
  potential.prediction = topology.rest_vertices;
  potential.loads = Points::Zero(topology.rest_vertices.rows(), 3);
  std::mt19937 random(8);
  for (bool single : {false, true}) {
    for (int history : {0, 5}) {
      ProjectiveDynamicsOptions options;
      options.minimizer = {20, 0.0, history};
      options.single_precision = single;
      ProjectiveDynamics solver(topology, {lameParameters(2.0e4, 0.3), SimulatorConfig().strain_smoothing},
                                options);
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

/// Simulator steps with refactored, updated and unchanged systems, in each precision.
class StepAllocations : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr Nanoseconds kFrame = 33333334;  // even: a step of half of it takes as long as the other
  static constexpr int kFrames = 15;
  const TetTopology topology_ = testing::sponge();
  std::mt19937 random_{21};

  SimulatorConfig config() const {
    SimulatorConfig config;
    config.load_fade_s = config.memory_s = 0.0;
    config.single_precision = GetParam();
    return config;
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Targets near the tets' upper faces, most of them with a normal.
  std::vector<Target> someTargets(int count) {
    std::vector<Target> targets(static_cast<std::size_t>(count));
    for (Target& target : targets) {
      target.place.tet = static_cast<int>(random_() % static_cast<unsigned>(topology_.tets.rows()));
      target.place.barycentric = {0.4, 0.3, 0.2, 0.1};
      move(&target);
      if (random_() % 4 > 0) target.normal = testing::randomPoints(1, 1.0, &random_).transpose().normalized();
    }
    return targets;
  }
  void move(Target* target) {
    target->position = positionOf(target->place, topology_.rest_vertices, topology_.tets) +
                       testing::randomPoints(1, 0.002, &random_).transpose();
  }

  /// Steps under the targets that `next` makes. Counts the allocations of each step after the first with
  /// elapsed time.
  template <typename Next>
  void expectNone(TargetSet targets, const Surroundings& surroundings, Next next) {
    Simulator simulator(topology_, Material(), config());
    targets.reset = true;
    for (int frame = 0; frame < kFrames; ++frame) {
      const long before = allocations;
      simulator.step(targets, frame * kFrame, surroundings);
      const long stepped = allocations - before;
      simulator.stepUnobserved(targets, frame * kFrame + kFrame / 2, surroundings);
      const long made = allocations - before;
      if (frame == 0) {
        EXPECT_GT(stepped, 0) << "the count does not count";
      } else if (frame > 1) {
        EXPECT_EQ(made, 0) << "frame " << frame;
      }
      for (const Wrench& reaction : simulator.reactions().obstacles) EXPECT_GT(reaction.force.norm(), 0.0);
      targets.reset = false;
      next(&targets.targets);
    }
  }
};

TEST_P(StepAllocations, NoneUnderAsManyTargetsAsBefore) {
  TargetSet targets;
  targets.targets = someTargets(1500);
  expectNone(targets, {}, [this](std::vector<Target>* all) {
    for (Target& target : *all) {
      target.weight = uniform(0.5, 2.0);
      move(&target);
    }
  });
}

TEST_P(StepAllocations, NoneUnderChangingTargets) {
  TargetSet targets;
  targets.targets = someTargets(1500);
  expectNone(targets, {}, [this](std::vector<Target>* all) {
    // In turns, a few targets appear and vanish, or all change.
    if (random_() % 2 == 0)
      *all = someTargets(static_cast<int>(random_() % 1500));
    else
      for (int k = 0; k < 5 && !all->empty(); ++k) all->pop_back();
    for (Target& target : *all) move(&target);
  });
}

TEST_P(StepAllocations, NoneUnderPinsAndContact) {
  TargetSet targets;
  targets.targets = someTargets(300);
  Surroundings surroundings;
  for (int v = 0; v < 12; ++v) surroundings.pins.push_back({v, topology_.rest_vertices.row(v)});
  surroundings.obstacles = {Obstacle::plane(), Obstacle::sphere(0.02)};
  surroundings.obstacles[0].pose = Eigen::Translation3d(0.0, 0.0, 0.002);
  surroundings.obstacles[1].pose = Eigen::Translation3d(0.15, 0.05, 0.045);
  surroundings.loads = Points::Constant(topology_.rest_vertices.rows(), 3, 1e-3);
  expectNone(targets, surroundings, [this](std::vector<Target>* all) {
    for (Target& target : *all) {
      target.weight = uniform(0.5, 2.0);
      move(&target);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Precisions, StepAllocations, ::testing::Bool());

}  // namespace
}  // namespace softbody
