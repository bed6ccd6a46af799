#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fixtures/synthetic_scene.h"
#include "prediction/rigid_prediction.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

RigidPrediction predictionOf(const TetTopology& volume) {
  return {volume.rest_vertices, verticesOfPieces(volume.tets, volume.rest_vertices.rows())};
}

/// A screw motion: turns about a fixed axis and shifts along it.
Points screwed(const Points& rest, double angle) {
  return transformed(rest, Eigen::Translation3d(0.0, 0.0, 0.02 * angle) *
                               Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) *
                               Eigen::Isometry3d::Identity());
}

TEST(RigidPrediction, GoesOnAsTheBodyMoved) {
  const TetTopology volume = makeBox().volume;
  const Points& rest = volume.rest_vertices;
  RigidPrediction prediction = predictionOf(volume);
  prediction.observe(screwed(rest, 0.1), 1000);
  EXPECT_EQ(prediction.at(2000), screwed(rest, 0.1)) << "one state is no motion";
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_LT((prediction.at(3000) - screwed(rest, 0.3)).norm(), 1e-9);
  EXPECT_LT((prediction.at(3500) - screwed(rest, 0.35)).norm(), 1e-9);
}

TEST(RigidPrediction, SaysNothingAfterAGapOrAJumpBack) {
  const TetTopology volume = makeBox().volume;
  const Points& rest = volume.rest_vertices;
  RigidPrediction prediction = predictionOf(volume);
  prediction.observe(screwed(rest, 0.1), 1000);
  prediction.observe(screwed(rest, 0.2), 2000);
  EXPECT_EQ(prediction.at(20000), screwed(rest, 0.2));
  prediction.observe(screwed(rest, 0.0), 500);
  EXPECT_EQ(prediction.at(1000), screwed(rest, 0.0));
}

TEST(RigidPrediction, PiecesGoTheirOwnWay) {
  const TetTopology box = makeBox().volume;
  const Eigen::Index count = box.rest_vertices.rows();
  TetTopology both = box;
  both.rest_vertices.conservativeResize(2 * count, 3);
  both.rest_vertices.bottomRows(count) = box.rest_vertices;
  both.tets.conservativeResize(2 * box.tets.rows(), 4);
  both.tets.bottomRows(box.tets.rows()) = box.tets.array() + static_cast<int>(count);
  const auto placed = [&](double first, double second) {
    Points vertices(2 * count, 3);
    vertices << screwed(box.rest_vertices, first), screwed(box.rest_vertices, second);
    return vertices;
  };
  RigidPrediction prediction = predictionOf(both);
  prediction.observe(placed(0.1, 0.3), 1000);
  prediction.observe(placed(0.2, 0.1), 2000);
  EXPECT_LT((prediction.at(3000) - placed(0.3, -0.1)).norm(), 1e-9);
  EXPECT_LT((prediction.at(3000, {MotionShare::Zero(), MotionShare::Identity()}) - placed(0.2, -0.1)).norm(),
            1e-9)
      << "it must stay";
}

constexpr Nanoseconds kInterval = 33333333;

/// A small random motion about the origin: half a millimetre, half a degree.
Eigen::Isometry3d shake(std::mt19937* random) {
  std::normal_distribution<double> shift(0.0, 0.0005), turn(0.0, 0.009);
  const Eigen::Vector3d rotation(turn(*random), turn(*random), turn(*random));
  return Eigen::Translation3d(shift(*random), shift(*random), shift(*random)) *
         Eigen::AngleAxisd(rotation.norm(), rotation.normalized());
}

/// Root mean square errors of predictions.
struct PredictionErrors {
  double averaged = 0.0;      ///< by RigidPrediction
  double extrapolated = 0.0;  ///< from the last two states
};

/// Predicts a body whose states shake. @param truth where the body is in a frame.
template <typename Truth>
PredictionErrors errorsOf(const TetTopology& volume, int frames, Truth truth) {
  std::mt19937 random(12);
  RigidPrediction prediction = predictionOf(volume);
  PredictionErrors sums;
  Points last, before;
  constexpr int kFirst = 10;  // it learns how exact it is
  for (int i = 0; i < frames; ++i) {
    if (i >= 2) {
      const Points predicted = prediction.at(i * kInterval);
      if (i >= kFirst) {
        sums.averaged += (predicted - truth(i)).squaredNorm();
        sums.extrapolated += (2.0 * last - before - truth(i)).squaredNorm();
      }
    }
    before = last;
    last = transformed(truth(i), shake(&random));
    prediction.observe(last, i * kInterval);
  }
  const double count = static_cast<double>((frames - kFirst) * volume.rest_vertices.rows());
  return {std::sqrt(sums.averaged / count), std::sqrt(sums.extrapolated / count)};
}

/// Two states with errors of size s extrapolate to an error of sqrt(5) s; the last one alone has the error s.
TEST(RigidPrediction, AveragesTheVelocityOfABodyAtRest) {
  const TetTopology volume = makeBox().volume;
  const PredictionErrors errors = errorsOf(volume, 200, [&](int) { return volume.rest_vertices; });
  EXPECT_LT(errors.averaged, 0.6 * errors.extrapolated);
}

TEST(RigidPrediction, AveragesASteadyVelocity) {
  const TetTopology volume = makeBox().volume;
  const PredictionErrors errors = errorsOf(volume, 200, [&](int i) {
    return transformed(volume.rest_vertices, Eigen::Isometry3d(Eigen::Translation3d(0.003 * i, 0.0, 0.0)));
  });
  EXPECT_LT(errors.averaged, 0.7 * errors.extrapolated);
}

/// After a long rest the velocity is averaged over many frames; a motion ends this.
TEST(RigidPrediction, FollowsASuddenMotionAfterNoisyRest) {
  const TetTopology volume = makeBox().volume;
  constexpr int kRest = 60;
  constexpr double kStep = 0.005;  // [m] in each frame
  std::mt19937 random(4);
  RigidPrediction prediction = predictionOf(volume);
  double error = 0.0;
  for (int i = 0; i < kRest + 10; ++i) {
    const Eigen::Isometry3d pose(Eigen::Translation3d(kStep * std::max(0, i - kRest), 0.0, 0.0));
    const Points truth = transformed(volume.rest_vertices, pose);
    if (i > 0) error = (prediction.at(i * kInterval) - truth).rowwise().norm().mean();
    prediction.observe(transformed(truth, shake(&random)), i * kInterval);
  }
  EXPECT_LT(error, 0.5 * kStep) << "the last of ten frames";
}

/// Live, a state comes after the next frame was predicted.
TEST(RigidPrediction, LateStatesAreComparedWithTheirPredictions) {
  const TetTopology volume = makeBox().volume;
  RigidPrediction prediction = predictionOf(volume);
  for (int i = 0; i < 30; ++i) {
    prediction.observe(screwed(volume.rest_vertices, 0.01 * i), i * kInterval);
    prediction.at((i + 1) * kInterval);
    prediction.at((i + 2) * kInterval);
  }
  EXPECT_LT((prediction.at(31 * kInterval) - screwed(volume.rest_vertices, 0.31)).norm(), 1e-6);
}

}  // namespace
}  // namespace softbody
