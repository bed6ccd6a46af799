#include "time_step/free_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

using testing::randomPoints;

struct Momentum {
  Eigen::RowVector3d linear = Eigen::RowVector3d::Zero(), angular = Eigen::RowVector3d::Zero();
};

/// Of the vertices from `first` on, about the origin.
Momentum momentumOf(const Eigen::VectorXd& masses, const Points& x, const Points& velocity,
                    Eigen::Index first, Eigen::Index count) {
  Momentum sum;
  for (Eigen::Index v = first; v < first + count; ++v) {
    sum.linear += masses[v] * velocity.row(v);
    sum.angular += masses[v] * x.row(v).cross(velocity.row(v));
  }
  return sum;
}

/// Two pieces with random masses.
class FreeMotions : public ::testing::Test {
 protected:
  const TetTopology topology_ = testing::twoBoxes({3, 2, 1}, {0.1, 0.05, 0.02});
  const Eigen::Index count_ = topology_.rest_vertices.rows(), half_ = count_ / 2;
  std::mt19937 random_{5};
  const Eigen::VectorXd masses_ = (randomPoints(count_, 0.5, &random_).col(0).array() + 1.0).matrix();
  const FreeMotion motion_{topology_, masses_};
};

TEST_F(FreeMotions, ASpinningPieceTurnsAndKeepsItsShape) {
  const Eigen::Vector3d spin(7.0, -3.0, 12.0), drift(0.4, 0.0, -1.0);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Points velocity = Points::Zero(count_, 3), x = topology_.rest_vertices;
  for (Eigen::Index v = 0; v < half_; ++v)
    center += masses_[v] * x.row(v).transpose() / masses_.head(half_).sum();
  for (Eigen::Index v = 0; v < half_; ++v)
    velocity.row(v) = drift + spin.cross(x.row(v).transpose() - center);
  motion_.advance(velocity, 0.1, &x);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.1 * spin.norm(), spin.normalized()).toRotationMatrix();
  for (Eigen::Index v = 0; v < count_; ++v) {
    const Eigen::Vector3d before = topology_.rest_vertices.row(v);
    const Eigen::Vector3d expected =
        v < half_ ? Eigen::Vector3d(center + 0.1 * drift + R * (before - center)) : before;
    EXPECT_LT((x.row(v).transpose() - expected).norm(), 1e-12);
  }
}

/// Also if the pieces deform and tumble.
TEST_F(FreeMotions, EachPieceKeepsItsMomenta) {
  Points x = topology_.rest_vertices, velocity = randomPoints(count_, 0.3, &random_);
  for (const Eigen::Index first : {Eigen::Index(0), half_}) {
    const Eigen::RowVector3d spin = randomPoints(1, 10.0, &random_).row(0);
    for (Eigen::Index v = first; v < first + half_; ++v) velocity.row(v) += spin.cross(x.row(v));
  }
  Momentum start[2];
  for (int piece : {0, 1}) start[piece] = momentumOf(masses_, x, velocity, piece * half_, half_);
  for (int step = 0; step < 100; ++step) {
    const Points before = x;
    motion_.advance(velocity, 0.003, &x);
    motion_.setVelocity(before, x, 0.003, &velocity);
  }
  for (int piece : {0, 1}) {
    const Momentum end = momentumOf(masses_, x, velocity, piece * half_, half_);
    EXPECT_LT((end.linear - start[piece].linear).norm(), 1e-9 * start[piece].linear.norm());
    EXPECT_LT((end.angular - start[piece].angular).norm(), 1e-3 * start[piece].angular.norm());
  }
}

TEST_F(FreeMotions, ACollapsedPieceStaysFinite) {
  for (const double scale : {0.0, 1e-14}) {
    const Points before = scale * topology_.rest_vertices;
    Points x = before, velocity = randomPoints(count_, 1.0, &random_);
    motion_.advance(velocity, 0.03, &x);
    motion_.setVelocity(before, x, 0.03, &velocity);
    EXPECT_TRUE(x.allFinite() && velocity.allFinite());
  }
}

}  // namespace
}  // namespace softbody
