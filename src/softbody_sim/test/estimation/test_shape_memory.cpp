#include "estimation/shape_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kInterval_s = 1.0 / 30.0;
constexpr double kNoise_m = 0.001;  // in each direction

/// A block whose vertices are measured with noise, and followed without elasticity: the next shape is where
/// the memory puts the targets.
class ShapeMemoryTest : public ::testing::Test {
 protected:
  using Motion = std::function<Eigen::RowVector3d(const Eigen::RowVector3d& rest, double time_s)>;

  /// Root mean square of the distance from the truth over the last frames [m], in one direction.
  double errorAfter(int frames, int last_frames, double noise_m, const Motion& motion,
                    const std::function<bool(const Eigen::RowVector3d&)>& counts = {}) {
    const Points& rest = topology_.rest_vertices;
    Points shape = rest, truth = rest;
    double sum = 0.0, terms = 0.0;
    mean_error_m_.setZero();
    for (int frame = 0; frame < frames; ++frame) {
      for (Eigen::Index v = 0; v < rest.rows(); ++v)
        truth.row(v) = rest.row(v) + motion(rest.row(v), frame * kInterval_s);
      std::vector<Target> storage;
      const std::vector<Target> targets = testing::vertexTargets(topology_, withNoise(truth, noise_m));
      const auto& means = memory_.recall(targets, shape, kInterval_s, &remembered_, &storage);
      for (std::size_t v = 0; v < means.size(); ++v) {
        const auto row = static_cast<Eigen::Index>(v);
        shape.row(row) = means[v].position;
        if (frame < frames - last_frames || (counts && !counts(rest.row(row)))) continue;
        sum += (shape.row(row) - truth.row(row)).squaredNorm();
        terms += 3.0;
        mean_error_m_ += shape.row(row) - truth.row(row);
      }
    }
    mean_error_m_ *= 3.0 / terms;
    return std::sqrt(sum / terms);
  }
  static Eigen::RowVector3d still(const Eigen::RowVector3d&, double) { return Eigen::RowVector3d::Zero(); }

  const TetTopology topology_ = testing::boxTopology({10, 3, 2}, {0.2, 0.06, 0.04});
  const ShapeMemory memory_{topology_.tets, 0.5};
  RememberedShape remembered_;
  Eigen::RowVector3d mean_error_m_;  ///< over the last frames

 private:
  Points withNoise(Points points, double noise_m) {
    std::normal_distribution<double> normal(0.0, noise_m);
    for (double& value : points.reshaped()) value += normal(random_);
    return points;
  }

  std::mt19937 random_{20221};
};

TEST_F(ShapeMemoryTest, NoiseAveragesOutAtRest) {
  EXPECT_LT(errorAfter(60, 20, kNoise_m, still), 0.6 * kNoise_m);
}

/// A slow motion, of less than the noise in a frame: the shape lags behind by a part of a frame at most.
TEST_F(ShapeMemoryTest, ASteadyMotionIsNotHeldBack) {
  const auto drift = [](const Eigen::RowVector3d&, double t) {
    return Eigen::RowVector3d(0.01 * t, 0.0, 0.0);
  };
  errorAfter(60, 20, kNoise_m, drift);
  EXPECT_LT(std::abs(mean_error_m_.x()), 0.01 * kInterval_s);
}

TEST_F(ShapeMemoryTest, AFastSwingIsNotHeldBack) {
  const auto swing = [](const Eigen::RowVector3d&, double t) {
    return Eigen::RowVector3d(0.0, 0.05 * std::sin(2.0 * M_PI * 2.0 * t), 0.0);
  };
  EXPECT_LT(errorAfter(90, 60, kNoise_m, swing), 1.5 * kNoise_m);
}

TEST_F(ShapeMemoryTest, AJumpIsFollowedInItsFrame) {
  const auto jump = [](const Eigen::RowVector3d&, double t) {
    return Eigen::RowVector3d(t < 1.99 ? 0.0 : 0.02, 0.0, 0.0);
  };
  EXPECT_LT(errorAfter(61, 1, kNoise_m, jump), 1.5 * kNoise_m);
}

TEST_F(ShapeMemoryTest, OnlyThePartThatMovesIsForgotten) {
  const double middle = topology_.rest_vertices.col(0).mean();
  const double edge = (topology_.rest_vertices.col(0).maxCoeff() - middle) / 2.0;
  const auto half_moves = [&](const Eigen::RowVector3d& rest, double t) {
    return Eigen::RowVector3d(0.0, 0.0, rest.x() > middle ? 0.1 * t : 0.0);
  };
  const auto is_far_from_it = [&](const Eigen::RowVector3d& rest) { return rest.x() < middle - 1.5 * edge; };
  EXPECT_LT(errorAfter(60, 20, kNoise_m, half_moves, is_far_from_it), 0.6 * kNoise_m);
}

TEST_F(ShapeMemoryTest, WithoutNoiseTargetsStayWhereTheyAre) {
  const auto drift = [](const Eigen::RowVector3d& rest, double t) {
    return Eigen::RowVector3d(rest * 0.2 * t);
  };
  EXPECT_LT(errorAfter(30, 30, 0.0, drift), 1e-6);
}

TEST_F(ShapeMemoryTest, WithoutTimeOrMemoryTheTargetsAreReturned) {
  const std::vector<Target> targets = testing::vertexTargets(topology_, topology_.rest_vertices);
  std::vector<Target> storage;
  EXPECT_EQ(&memory_.recall(targets, topology_.rest_vertices, 0.0, &remembered_, &storage), &targets);
  EXPECT_EQ(remembered_.frames.size(), 0);
  const ShapeMemory none(topology_.tets, 0.0);
  EXPECT_EQ(&none.recall(targets, topology_.rest_vertices, kInterval_s, &remembered_, &storage), &targets);
}

/// What is predicted is no measurement: it neither changes nor counts.
TEST_F(ShapeMemoryTest, PriorsStayAsTheyAre) {
  std::vector<Target> targets = testing::vertexTargets(topology_, topology_.rest_vertices), storage;
  for (Target& target : targets) {
    target.kind = TargetKind::kPrior;
    target.position.x() += 0.01;
  }
  const auto& means = memory_.recall(targets, topology_.rest_vertices, kInterval_s, &remembered_, &storage);
  for (std::size_t t = 0; t < targets.size(); ++t) EXPECT_EQ(means[t].position, targets[t].position);
  EXPECT_EQ(remembered_.frames.maxCoeff(), 0.0);
}

}  // namespace
}  // namespace softbody
