#include <gtest/gtest.h>

#include <random>

#include "identification/mean_wrench.h"
#include "identification/recorded_observations.h"
#include "identification/rigid_pins.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33333333;

/// 60 places of a body, the first 20 held by a clamp; what a tracker with noise sees of it.
class RecordedBody : public ::testing::Test {
 protected:
  RecordedBody() : rest_(60, 3) {
    for (Eigen::Index v = 0; v < rest_.rows(); ++v)
      rest_.row(v) << 0.01 * static_cast<double>(v / 4), 0.02 * static_cast<double>(v % 2),
          0.02 * static_cast<double>(v / 2 % 2);
  }

  void addFrame(double sag_m, double noise_m,
                const Eigen::Isometry3d& clamp = Eigen::Isometry3d::Identity()) {
    std::normal_distribution<double> normal(0.0, noise_m);
    SeenFrame frame;
    frame.stamp = static_cast<Nanoseconds>(frames_.size()) * kFrame;
    frame.vertices = rest_;
    for (Eigen::Index v = 20; v < rest_.rows(); ++v)
      frame.vertices(v, 2) -= sag_m * std::pow((rest_(v, 0) - rest_(20, 0)) / 0.1, 2);
    frame.vertices = transformed(frame.vertices, clamp * pose_);
    frame.vertices += Points::NullaryExpr(60, 3, [&] { return normal(random_); });
    for (int v = 0; v < 20; ++v) {
      // Held where the tracker saw them in the first frame.
      const Eigen::Vector3d at =
          frames_.empty() ? frame.vertices.row(v).transpose() : Eigen::Vector3d(frames_[0].vertices.row(v));
      frame.around.all.pins.push_back({v, clamp * at, 0.001});
      frame.around.pins.push_back("clamp");
    }
    frame.targets.resize(3);
    frames_.push_back(frame);
  }

  Points rest_;
  Eigen::Isometry3d pose_ = Eigen::Translation3d(0.1, 0.2, 0.5) *
                            Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  std::mt19937 random_{1};
  std::vector<SeenFrame> frames_;
};

TEST_F(RecordedBody, PinsHoldTheRestShapeWhereMostFramesSeeIt) {
  for (int k = 0; k < 30; ++k) addFrame(0.0, k == 0 ? 0.005 : 0.0003);
  for (int k = 0; k < 60; ++k) addFrame(0.03, 0.0003);
  const auto pins = rigidPins(frames_, rest_, 0.001);
  for (const Pin& pin : pins.back())
    EXPECT_LT((pin.position - pose_ * Eigen::Vector3d(rest_.row(pin.vertex))).norm(), 0.0003) << pin.vertex;
}

TEST_F(RecordedBody, PinsFollowTheirFrame) {
  addFrame(0.0, 0.0);
  const Eigen::Isometry3d moved =
      Eigen::Translation3d(0.02, 0.0, 0.01) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  addFrame(0.0, 0.0, moved);
  const auto pins = rigidPins(frames_, rest_, 0.001);
  for (const Pin& pin : pins.back())
    EXPECT_LT((pin.position - moved * pose_ * Eigen::Vector3d(rest_.row(pin.vertex))).norm(), 1e-9);
}

TEST_F(RecordedBody, TheLastRestIsUsedIfNothingMoves) {
  for (int k = 0; k < 30; ++k) addFrame(0.0, 0.0001);
  for (int k = 0; k < 30; ++k) addFrame(0.001 * k, 0.0001);
  for (int k = 0; k < 40; ++k) addFrame(0.03, 0.0001);
  const RecordedObservations recorded = observationsOf(frames_, {}, rest_, false);
  ASSERT_EQ(recorded.observations.size(), 1u);
  EXPECT_EQ(recorded.observations[0].stamp, frames_.back().stamp);
  EXPECT_EQ(recorded.observations[0].targets.size(), 3u * 30u);
  EXPECT_EQ(recorded.observations[0].images.back(), 29);
}

TEST_F(RecordedBody, ABodyThatNeverRestsIsNamed) {
  for (int k = 0; k < 60; ++k) addFrame(0.001 * k, 0.0001);
  EXPECT_THROW(observationsOf(frames_, {}, rest_, false), std::invalid_argument);
}

TEST_F(RecordedBody, AMovingClampGivesMomentsWithItsWrench) {
  WrenchRecord record{"clamp", "/wrench/clamp", 0.0, {}, false};
  std::normal_distribution<double> normal(0.0, 0.05);
  for (int k = 0; k < 90; ++k) {
    addFrame(0.0, 0.0, Eigen::Isometry3d(Eigen::Translation3d(0.001 * k, 0.0, 0.0)));
    WrenchSample sample;
    sample.stamp = frames_.back().stamp;
    sample.value.force = {0.1 * k + normal(random_), normal(random_), normal(random_)};
    record.samples.push_back(sample);
  }
  EXPECT_NEAR(noiseOf(record.samples), 0.05, 0.01);
  const RecordedObservations recorded = observationsOf(frames_, {record}, rest_, false);
  EXPECT_EQ(recorded.observations.size(), 24u);
  for (const ShapeObservation& observation : recorded.observations) {
    ASSERT_EQ(observation.wrenches.size(), 1u);
    EXPECT_EQ(observation.wrenches[0].vertices.size(), 20u);
    const double k = static_cast<double>(observation.stamp) / kFrame;
    EXPECT_NEAR(observation.wrenches[0].value.force.x(), 0.1 * k, 0.2);
    EXPECT_LE(observation.wrenches[0].force_std_n, 0.06);
  }
}

}  // namespace
}  // namespace softbody
