#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "statistics/median.h"
#include "tracker/frame_matcher.h"
#include "tracker/frame_observer.h"

namespace softbody {
namespace {

constexpr int kFeatures = 600;

/// A box that the observer knows from its first frame. Features are matched between frames.
class FramesOfBox : public ::testing::Test {
 protected:
  FramesOfBox() {
    config_.features.between_frames = true;
    config_.features.max_features = kFeatures;
    restart();
  }

  /// Only the first frame is known.
  void restart() {
    observer_ = std::make_unique<FrameObserver>(config_, box_.volume, box_.surface);
    show(boxPose(), boxPose());
  }

  Observation show(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& predicted) {
    truth_ = transformed(box_.volume.rest_vertices, pose);
    const RgbdFrame frame = renderFrame(box_, truth_, stamp_ += kFrameInterval);
    ObservedBody observed = observer_->observe(frame, transformed(box_.volume.rest_vertices, predicted));
    observer_->learnFeatures(frame, observed);
    return std::move(observed.seen);
  }

  /// Median distance of the inliers from their true places [m].
  double medianError(const Observation& seen) const {
    std::vector<double> errors;
    for (const FeatureMatch& match : seen.matches) {
      const Eigen::Vector3d place = positionOf(match.association.place, truth_, box_.volume.tets);
      if (match.inlier) errors.push_back((match.association.measured - place).norm());
    }
    return errors.empty() ? 1.0 : median(&errors);
  }

  static long inliers(const Observation& seen) {
    return std::count_if(seen.matches.begin(), seen.matches.end(), [](const auto& m) { return m.inlier; });
  }

  BoxBody box_ = makeBox();
  TrackerConfig config_;
  std::unique_ptr<FrameObserver> observer_;
  Nanoseconds stamp_ = 0;
  Points truth_;
};

TEST_F(FramesOfBox, ReachesTheNumberOfFeaturesThatWasAskedFor) {
  EXPECT_EQ(observer_->features().size(), static_cast<std::size_t>(kFeatures));
}

/// Far more than the 20 px in which patches are looked for.
TEST_F(FramesOfBox, FindsFeaturesWhereverTheyMoved) {
  const Observation seen = show(Eigen::Translation3d(0.05, 0.03, 0.0) * boxPose(), boxPose());
  EXPECT_GT(inliers(seen), kFeatures / 3);
  EXPECT_LT(medianError(seen), 0.002);
}

/// Tilted so far that its first look is hardly recognised.
TEST_F(FramesOfBox, CarriesTheDescriptorOfTheLastFrame) {
  const auto tilted = [](double share) {
    return Eigen::Isometry3d(boxPose() * Eigen::AngleAxisd(0.7 * share, Eigen::Vector3d::UnitX()));
  };
  const long at_once = inliers(show(tilted(1.0), tilted(1.0)));
  restart();
  Observation seen;
  for (int i = 1; i <= 20; ++i) seen = show(tilted(i / 20.0), tilted(i / 20.0));
  EXPECT_GT(inliers(seen), at_once + 30);
  EXPECT_LT(medianError(seen), 0.005);
}

}  // namespace
}  // namespace softbody
