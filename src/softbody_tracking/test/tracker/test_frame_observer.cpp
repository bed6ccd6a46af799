#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <random>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "tracker/frame_observer.h"

namespace softbody {
namespace {

/// The box's front, then its back.
class TurnedBox : public ::testing::Test {
 protected:
  explicit TurnedBox(int max_features = 1000, const BoxBody& box = makeBox()) : box_(box) {
    config_.max_features = max_features;
    observer_ = std::make_unique<FrameObserver>(config_, box_.volume, box_.surface);
  }

  Observation show(const Eigen::Isometry3d& pose) {
    return show(pose, pose, [](RgbdFrame*) {});
  }

  template <typename Edit>
  Observation show(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& predicted, Edit edit) {
    RgbdFrame frame =
        renderFrame(box_, transformed(box_.volume.rest_vertices, pose), stamp_ += kFrameInterval);
    edit(&frame);
    ObservedBody observed = observer_->observe(frame, transformed(box_.volume.rest_vertices, predicted));
    observer_->learnFeatures(frame, observed);
    return std::move(observed.seen);
  }

  int known() const { return static_cast<int>(observer_->features().size()); }

  Eigen::Vector3d restPosition(const MapFeature& feature) const {
    return positionOf(feature.place, box_.volume.rest_vertices, box_.volume.tets);
  }

  /// Half of the front is covered at first, then free. @return number of features known while it was covered.
  std::size_t uncoverFront() {
    show(front_, front_, [](RgbdFrame* frame) {
      const cv::Rect left(0, 0, 320, 480);
      frame->depth(left).setTo(0.3f);
      frame->color(left).setTo(cv::Vec3b(250, 20, 20));
    });
    const int first = known();
    EXPECT_GT(first, 100);
    for (int i = 0; i < 12; ++i) show(front_);
    EXPECT_GT(known(), first + 30);
    return static_cast<std::size_t>(first);
  }

  BoxBody box_;
  const Eigen::Isometry3d front_ = boxPose(),
                          back_ = boxPose() * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  TrackerConfig config_;
  std::unique_ptr<FrameObserver> observer_;
  Nanoseconds stamp_ = 0;
};

/// The deviation grows linearly along x at rest.
TEST_F(TurnedBox, FeaturesKnowHowUncertainTheirPlacesAre) {
  const auto deviationAt = [](const Eigen::Vector3d& rest) { return 0.01 + 0.02 * rest.x(); };
  const RgbdFrame frame =
      renderFrame(box_, transformed(box_.volume.rest_vertices, front_), stamp_ += kFrameInterval);
  const ObservedBody observed = observer_->observe(frame, transformed(box_.volume.rest_vertices, front_));
  std::vector<float> deviations;
  for (const auto& vertex : box_.volume.rest_vertices.rowwise())
    deviations.push_back(static_cast<float>(deviationAt(vertex.transpose())));
  observer_->learnFeatures(frame, observed, deviations);
  ASSERT_GT(known(), 100);
  for (const MapFeature& feature : observer_->features())
    EXPECT_NEAR(std::sqrt(feature.place_variance), deviationAt(restPosition(feature)), 1e-6);
}

TEST_F(TurnedBox, GetsFeaturesInAllQuartersOfANewSide) {
  for (int i = 0; i < 40; ++i) show(front_);
  const int before = known();
  EXPECT_GT(before, 200);
  int frames = 0;
  while (known() == before && frames < 100) show(back_), ++frames;
  EXPECT_LE(frames, 9) << "rested, new features are looked for in every ninth frame";
  for (int i = 0; i < 15; ++i) show(back_);
  std::array<int, 4> of_quarter{};
  for (const MapFeature& feature : observer_->features()) {
    const Eigen::Vector3d place = restPosition(feature);
    if (feature.id >= before) ++of_quarter.at((place.x() > 0.0 ? 1 : 0) + (place.y() > 0.0 ? 2 : 0));
  }
  const int all = std::accumulate(of_quarter.begin(), of_quarter.end(), 0);
  EXPECT_GT(all, 150);
  EXPECT_GT(*std::min_element(of_quarter.begin(), of_quarter.end()), all / 8);
}

TEST_F(TurnedBox, GetsLaterFeaturesInGapsOnly) {
  const std::size_t first = uncoverFront();
  const std::vector<MapFeature>& features = observer_->features();
  const double gap = 0.3 * meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets);
  for (std::size_t later = first; later < features.size(); ++later) {
    for (std::size_t other = 0; other < later; ++other)
      EXPECT_GT((restPosition(features[later]) - restPosition(features[other])).norm(), gap);
  }
}

class BoxOfFineVolume : public TurnedBox {
 protected:
  BoxOfFineVolume() : TurnedBox(4000, makeBox(40, 20, 8)) {}

  Eigen::Vector2d pixel(const MapFeature& feature) const {
    return Pinhole{640, 480, 615.0, 615.0, 320.0, 240.0}.project(front_ * restPosition(feature));
  }
};

/// The gaps of its volume are a few pixels wide.
TEST_F(BoxOfFineVolume, GetsNoFeaturesInPatchesOfOthers) {
  const std::size_t first = uncoverFront();
  const std::vector<MapFeature>& features = observer_->features();
  for (std::size_t later = first; later < features.size(); ++later) {
    for (std::size_t other = 0; other < first; ++other)
      EXPECT_GT((pixel(features[later]) - pixel(features[other])).cwiseAbs().maxCoeff(), 6.0);
  }
}

TEST_F(TurnedBox, GetsNoMoreFeaturesThanItsVolumeAsksFor) {
  for (int i = 0; i < 12; ++i) show(front_);
  const Pinhole camera{640, 480, 615.0, 615.0, 320.0, 240.0};
  RasterMemory memory;
  const View view = render(std::make_shared<SurfaceModel>(box_.volume, box_.surface), camera,
                           transformed(box_.volume.rest_vertices, front_), ViewSettings(config_), &memory);
  EXPECT_NEAR(known(), 4 * shownVertices(view.samples, box_.volume), 4);
}

TEST_F(BoxOfFineVolume, GetsAllThatShow) {
  for (int i = 0; i < 12; ++i) show(front_);
  EXPECT_GT(known(), 600);
}

/// Stripes of another colour, like a cable before the body or the line of a pen.
TEST_F(TurnedBox, TrustsLittleWhatLooksUnlikeItsPatch) {
  show(front_);
  const Observation seen = show(front_, front_, [](RgbdFrame* frame) {
    for (int u = 0; u < 640; u += 40) frame->color.colRange(u, u + 5).setTo(cv::Vec3b(30, 90, 120));
  });
  double usual = 0.0, odd = 0.0;
  int odd_count = 0;
  for (const FeatureMatch& match : seen.matches) {
    const bool is_odd = match.unexplained > 0.1;
    odd_count += is_odd ? 1 : 0;
    (is_odd ? odd : usual) = std::max(is_odd ? odd : usual, match.association.weight);
  }
  ASSERT_GT(odd_count, 10);
  EXPECT_LT(odd, 0.2 * usual);
}

/// A sequence that changes all states of the observer: features of several tiles, and failed searches.
class ResetBox : public TurnedBox {
 protected:
  std::vector<FeatureMatch> session() {
    const Eigen::Isometry3d far = Eigen::Translation3d(0.08, 0.0, 0.0) * front_;
    const auto fade = [](RgbdFrame* frame) { frame->color.setTo(cv::Vec3b(35, 90, 140)); };
    std::vector<FeatureMatch> matches;
    const auto add = [&](const Observation& seen) {
      matches.insert(matches.end(), seen.matches.begin(), seen.matches.end());
    };
    add(show(front_));
    add(show(front_, far, [](RgbdFrame*) {}));
    for (int i = 0; i < 7; ++i) add(show(back_));
    for (int i = 0; i < 7; ++i) add(show(front_, front_, fade));
    return matches;
  }
};

TEST_F(ResetBox, IsAsAtFirst) {
  const std::vector<FeatureMatch> matches = session();
  const std::vector<MapFeature> features = observer_->features();
  ASSERT_GT(matches.size(), 500u);
  observer_->reset();
  const std::vector<FeatureMatch> again = session();
  ASSERT_EQ(matches.size(), again.size());
  for (std::size_t m = 0; m < matches.size(); ++m) {
    EXPECT_EQ(matches[m].feature, again[m].feature);
    EXPECT_EQ(matches[m].pixel, again[m].pixel);
    EXPECT_EQ(matches[m].association.weight, again[m].association.weight);
  }
  ASSERT_EQ(known(), static_cast<int>(features.size()));
  for (std::size_t f = 0; f < features.size(); ++f) {
    const MapFeature& other = observer_->features()[f];
    EXPECT_EQ(features[f].id, other.id);
    EXPECT_EQ(features[f].place.tet, other.place.tet);
    EXPECT_EQ(features[f].place.barycentric, other.place.barycentric);
    EXPECT_EQ(features[f].found_s, other.found_s);
  }
}

class NoisyBox : public TurnedBox {
 protected:
  /// Mean weight of the depth targets. @param noise_m of every pixel. @param hand covers this region.
  double meanWeight(float noise_m, const cv::Rect& hand = {}) {
    double sum = 0.0;
    const Observation seen = show(front_, front_, [&](RgbdFrame* frame) {
      std::normal_distribution<float> gauss(0.0f, noise_m);
      for (float& z : frame->depth) z += gauss(random_);
      frame->depth(hand).setTo(0.3f);
    });
    for (const Association& association : seen.depth.associations) sum += association.weight;
    return sum / static_cast<double>(seen.depth.associations.size());
  }

  std::mt19937 random_{2};
};

TEST_F(NoisyBox, TrustsNoisyDepthLess) {
  const double usual = meanWeight(0.001f);
  for (int i = 0; i < 5; ++i) meanWeight(0.018f);
  EXPECT_LT(meanWeight(0.018f), 0.7 * usual);
}

TEST_F(NoisyBox, TrustsDepthAlikeWhileAHandCoversIt) {
  double before = 0.0;
  for (int i = 0; i < 5; ++i) before = meanWeight(0.018f);
  for (const int hidden : {300, 360, 390})
    EXPECT_NEAR(meanWeight(0.018f, {0, 0, hidden, 480}), before, 0.15 * before) << hidden;
}

TEST_F(NoisyBox, IsAsNoisyAfterACut) {
  const double usual = meanWeight(0.001f);
  for (int i = 0; i < 5; ++i) meanWeight(0.018f);
  box_ = cutBox(box_);
  observer_->setTopologies(box_.volume, box_.surface);
  EXPECT_LT(meanWeight(0.0f, {0, 0, 390, 480}), 0.7 * usual) << "little shows";
}

TEST_F(NoisyBox, ForgetsTheNoiseWhenReset) {
  const double first = meanWeight(0.018f);
  meanWeight(0.001f);
  observer_->reset();
  random_.seed(2);
  EXPECT_EQ(meanWeight(0.018f), first);
}

/// A hand covers features, and vertices that these would measure.
TEST_F(TurnedBox, TrustsFeaturesAlikeWhileAHandCoversOthers) {
  const auto heaviest = [](const Observation& seen) {
    double weight = 0.0;
    for (const FeatureMatch& match : seen.matches) weight = std::max(weight, match.association.weight);
    return weight;
  };
  for (int i = 0; i < 12; ++i) show(front_);
  const double free = heaviest(show(front_));
  const Observation covered = show(front_, front_, [](RgbdFrame* frame) {
    const cv::Rect left(0, 0, 360, 480);
    frame->depth(left).setTo(0.3f);
    frame->color(left).setTo(cv::Vec3b(250, 20, 20));
  });
  EXPECT_GT(covered.matches.size(), 100u);
  EXPECT_LT(covered.matches.size(), 350u);
  EXPECT_NEAR(heaviest(covered), free, 0.2 * free);
}

class BoxOfFewFeatures : public TurnedBox {
 protected:
  BoxOfFewFeatures() : TurnedBox(40) {}
};

/// The map is full, so the searches of tiles do not slow down.
TEST_F(BoxOfFewFeatures, GetsFeaturesOfANewSideAtOnce) {
  for (int i = 0; i < 60; ++i) show(front_);
  const int before = known();
  ASSERT_GE(before, 40);
  for (int i = 0; i < 3; ++i) show(back_);
  EXPECT_GT(known(), before);
}

/// On a body of one colour the few features are often wrong.
TEST_F(BoxOfFewFeatures, TrustsNoneMore) {
  show(front_);
  const std::vector<FeatureMatch> matches = show(front_).matches;
  ASSERT_GT(matches.size(), 20u);
  const auto heaviest = std::max_element(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.association.weight < b.association.weight;
  });
  EXPECT_LE(heaviest->association.weight, kFeatureWeight);
}

}  // namespace
}  // namespace softbody
