#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/frame_observer.h"
#include "softbody_common/rigid_fit.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

/// The box's front, then its back.
class TurnedBox : public ::testing::Test {
 protected:
  explicit TurnedBox(int max_features = 1000) {
    config_.features.max_features = max_features;
    observer_ = std::make_unique<FrameObserver>(config_, box_.volume, box_.surface);
  }

  Observation show(const Eigen::Isometry3d& pose) {
    const Points vertices = transformed(box_.volume.rest_vertices, pose);
    const RgbdFrame frame = renderFrame(box_, vertices, 1);
    Observation seen = observer_->observe(frame, vertices);
    observer_->admit(frame, seen);
    return seen;
  }

  int known() const { return static_cast<int>(observer_->map().features().size()); }

  BoxBody box_ = makeBox();
  const Eigen::Isometry3d front_ = boxPose(),
                          back_ = boxPose() * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  TrackerConfig config_;
  std::unique_ptr<FrameObserver> observer_;
};

TEST_F(TurnedBox, GetsFeaturesInAllQuartersOfANewSide) {
  for (int i = 0; i < 40; ++i) show(front_);
  const int before = known();
  EXPECT_GT(before, 200);
  int frames = 0;
  while (known() == before && frames < 100) show(back_), ++frames;
  EXPECT_LE(frames, 9) << "rested, new features are looked for in every ninth frame";
  for (int i = 0; i < 15; ++i) show(back_);
  std::array<int, 4> of_quarter{};
  for (const MapFeature& feature : observer_->map().features()) {
    const Eigen::Vector3d place = positionOf(feature.place, box_.volume.rest_vertices, box_.volume.tets);
    if (feature.id >= before) ++of_quarter.at((place.x() > 0.0 ? 1 : 0) + (place.y() > 0.0 ? 2 : 0));
  }
  EXPECT_GT(*std::min_element(of_quarter.begin(), of_quarter.end()), 30);
}

class BoxOfFewFeatures : public TurnedBox {
 protected:
  BoxOfFewFeatures() : TurnedBox(40) {}
};

/// As many as are wanted, so nothing was looked through in vain.
TEST_F(BoxOfFewFeatures, GetsFeaturesOfANewSideAtOnce) {
  for (int i = 0; i < 60; ++i) show(front_);
  const int before = known();
  ASSERT_GE(before, 40);
  for (int i = 0; i < 3; ++i) show(back_);
  EXPECT_GT(known(), before);
}

TEST_F(BoxOfFewFeatures, TrustsEachMore) {
  show(front_);
  const std::vector<FeatureMatch> matches = show(front_).matches;
  ASSERT_GT(matches.size(), 20u);
  const auto heaviest = std::max_element(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.association.weight < b.association.weight;
  });
  EXPECT_GT(heaviest->association.weight, 2.0 * config_.features.weight);
}

}  // namespace
}  // namespace softbody
