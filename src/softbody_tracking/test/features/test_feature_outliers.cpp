#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "alignment/rigid_alignment.h"
#include "features/feature_outliers.h"
#include "softbody_common/protocol/target_limits.h"

namespace softbody {
namespace {

const Pinhole kCamera{640, 480, 600.0, 600.0, 319.5, 239.5};

/// The body's true motion and bend relative to the prediction [m].
Eigen::Vector3d truth(const Eigen::Vector3d& predicted, const Eigen::Vector3d& shift) {
  return predicted + shift + Eigen::Vector3d(0.0, 0.0, 0.5 * predicted.x() * predicted.x());
}

struct Scene {
  std::vector<FeatureMatch> matches;
  std::vector<bool> wrong;
};

/// Features all over a body at half a metre, with a noise of 0.3 px and 1 mm of depth; a share of them is
/// wrong by 4 to 12 px.
Scene makeScene(int count, double wrong_share, const Eigen::Vector3d& shift, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> gauss;
  Scene scene;
  for (int i = 0; i < count; ++i) {
    FeatureMatch match;
    match.feature = i;
    match.association.predicted = {0.12 * uniform(*random), 0.08 * uniform(*random), 0.5};
    const Eigen::Vector3d place = truth(match.association.predicted, shift);
    Eigen::Vector2d pixel = kCamera.project(place) + 0.3 * Eigen::Vector2d(gauss(*random), gauss(*random));
    scene.wrong.push_back(i < wrong_share * count);
    if (scene.wrong.back()) {
      const double angle = M_PI * uniform(*random), length = 8.0 + 4.0 * uniform(*random);
      pixel += length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    match.pixel = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    match.association.measured = kCamera.unproject(pixel.x(), pixel.y(), place.z() + 0.001 * gauss(*random));
    scene.matches.push_back(match);
  }
  return scene;
}

class FeatureOutliers : public testing::TestWithParam<unsigned> {
 protected:
  Scene scene(int count, double wrong_share) {
    std::uniform_real_distribution<double> uniform(-0.01, 0.01);
    shift_ = {uniform(random_), uniform(random_), uniform(random_)};
    Scene made = makeScene(count, wrong_share, shift_, &random_);
    markOutliers(kCamera, &made.matches);
    return made;
  }

  /// Mean distance of the kept matches from the truth, across the ray [m].
  double meanError(const Scene& scene) const {
    double sum = 0.0;
    int count = 0;
    for (const FeatureMatch& match : scene.matches) {
      if (!match.inlier) continue;
      const Eigen::Vector3d off = match.association.measured - truth(match.association.predicted, shift_);
      sum += off.cross(match.association.measured.normalized()).norm();
      ++count;
    }
    return sum / count;
  }

  std::mt19937 random_{GetParam()};
  Eigen::Vector3d shift_;
};
INSTANTIATE_TEST_SUITE_P(Seeds, FeatureOutliers, testing::Range(0u, 20u));

TEST_P(FeatureOutliers, WrongOnesAreFoundOutAndRightOnesStay) {
  const Scene made = scene(800, 0.2);
  int wrong_kept = 0, right_kept = 0, wrong = 0;
  for (std::size_t m = 0; m < made.matches.size(); ++m) {
    wrong += made.wrong[m] ? 1 : 0;
    (made.wrong[m] ? wrong_kept : right_kept) += made.matches[m].inlier ? 1 : 0;
  }
  EXPECT_EQ(wrong, 160);
  EXPECT_LT(wrong_kept, 0.02 * wrong);
  EXPECT_GT(right_kept, 0.98 * (800 - wrong));
}

TEST_P(FeatureOutliers, AFifthOfWrongOnesHardlyAddsToTheError) {
  const double without = meanError(scene(800, 0.0));
  EXPECT_LT(meanError(scene(800, 0.2)), 1.2 * without);
}

/// Compares the rigid step of the kept matches with that of the right matches alone.
TEST_P(FeatureOutliers, TheRigidStepDoesNotFollowThem) {
  const Scene made = scene(800, 0.2);
  std::vector<FeatureMatch> right;
  for (std::size_t m = 0; m < made.matches.size(); ++m)
    if (!made.wrong[m]) right.push_back(made.matches[m]);
  const Eigen::Isometry3d kept = rigidStep(refsTo(inliers(made.matches))),
                          ideal = rigidStep(refsTo(inliers(right)));
  for (const FeatureMatch& match : right) {
    const Eigen::Vector3d& place = match.association.predicted;
    EXPECT_LT((kept * place - ideal * place).cross(place.normalized()).norm(), 2e-4);
  }
}

/// For example of a repeating pattern, a sliding highlight or an object before the body.
TEST_P(FeatureOutliers, ManyThatAgreeOnAnotherMotionDoNotLeadThePiece) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const auto& [share, shift_px] : {std::pair(0.33, 8.0f), std::pair(0.15, 3.0f)}) {
    Scene made = makeScene(800, 0.0, Eigen::Vector3d::Zero(), &random_);
    for (std::size_t m = 0; m < made.matches.size(); ++m) {
      FeatureMatch& match = made.matches[m];
      made.wrong[m] = uniform(random_) < share;
      if (!made.wrong[m]) continue;
      match.pixel.x += shift_px;
      match.association.measured.x() += shift_px / kCamera.fx * match.association.measured.z();
    }
    markOutliers(kCamera, &made.matches);
    int wrong_kept = 0, right_lost = 0;
    for (std::size_t m = 0; m < made.matches.size(); ++m) {
      wrong_kept += made.wrong[m] && made.matches[m].inlier ? 1 : 0;
      right_lost += !made.wrong[m] && !made.matches[m].inlier ? 1 : 0;
    }
    EXPECT_LT(wrong_kept, 120 * share) << shift_px;
    EXPECT_LT(right_lost, 40) << shift_px;
  }
}

/// A tenth of the features lies on a piece between the others that moves by itself.
TEST_P(FeatureOutliers, PiecesAreJudgedByThemselves) {
  Scene made = makeScene(800, 0.0, Eigen::Vector3d::Zero(), &random_);
  for (std::size_t m = 0; m < made.matches.size(); m += 10) {
    made.matches[m].association.piece = 1;
    made.matches[m].association.predicted.x() += 0.005;
  }
  markOutliers(kCamera, &made.matches);
  const auto kept = std::count_if(made.matches.begin(), made.matches.end(),
                                  [](const FeatureMatch& match) { return match.inlier; });
  EXPECT_GT(kept, 0.97 * 800);
}

/// Features at the body's side that move by a few pixels more than those around them.
std::vector<FeatureMatch> limb(int count, double shift_px, const Eigen::Vector3d& shift,
                               std::mt19937* random) {
  std::vector<FeatureMatch> matches = makeScene(count, 0.0, shift, random).matches;
  for (FeatureMatch& match : matches) {
    Association& seen = match.association;
    const Eigen::Vector3d place(0.11 + 0.1 * seen.predicted.x(), 0.1 * seen.predicted.y(), 0.5);
    seen.measured += truth(place, shift) - truth(seen.predicted, shift);
    seen.measured.y() += shift_px * seen.measured.z() / kCamera.fy;
    seen.predicted = place;
    const Eigen::Vector2d pixel = kCamera.project(seen.measured);
    match.pixel = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
  }
  return matches;
}

/// For example when the limb bends, which the prediction does not contain.
TEST_P(FeatureOutliers, ALimbThatMovesOtherwiseThanTheBodyBesideItStays) {
  for (const double wrong_share : {0.0, 0.2}) {
    Scene made = makeScene(800, wrong_share, Eigen::Vector3d::Zero(), &random_);
    const std::vector<FeatureMatch> its = limb(40, 2.5, Eigen::Vector3d::Zero(), &random_);
    made.matches.insert(made.matches.end(), its.begin(), its.end());
    markOutliers(kCamera, &made.matches);
    const auto kept =
        std::count_if(made.matches.begin() + 800, made.matches.end(), [](const auto& m) { return m.inlier; });
    EXPECT_GT(kept, 34) << wrong_share;
    int wrong_kept = 0;
    for (int m = 0; m < 800; ++m) wrong_kept += made.wrong[m] && made.matches[m].inlier ? 1 : 0;
    EXPECT_LE(wrong_kept, 3);
  }
}

/// For example the image of another object.
TEST_P(FeatureOutliers, AGroupThatIsSmallOrFarOffDoesNotStay) {
  struct Group {
    int count;
    double shift_px;
  };
  for (const Group& group : {Group{12, 2.5}, Group{40, 6.0}}) {
    Scene made = makeScene(800, 0.0, Eigen::Vector3d::Zero(), &random_);
    const std::vector<FeatureMatch> its =
        limb(group.count, group.shift_px, Eigen::Vector3d::Zero(), &random_);
    made.matches.insert(made.matches.end(), its.begin(), its.end());
    markOutliers(kCamera, &made.matches);
    const auto kept =
        std::count_if(made.matches.begin() + 800, made.matches.end(), [](const auto& m) { return m.inlier; });
    EXPECT_LE(kept, 1) << group.count;
  }
}

TEST_P(FeatureOutliers, FewWithoutNeighborsAreJudgedByTheirLengthAlone) {
  Scene made = makeScene(3, 0.0, Eigen::Vector3d::Zero(), &random_);
  for (FeatureMatch& match : made.matches)
    match.association.measured = match.association.predicted + Eigen::Vector3d(0.004, 0.0, 0.0);
  made.matches[0].association.measured.x() += 0.004;
  markOutliers(kCamera, &made.matches);
  EXPECT_FALSE(made.matches[0].inlier);
  EXPECT_TRUE(made.matches[1].inlier);
  EXPECT_TRUE(made.matches[2].inlier);
}

/// A few features of a small piece lie among many of another one.
TEST(FeatureOutliersOfPieces, AreJudgedByTheirOwnPiece) {
  std::mt19937 random(4);
  std::vector<FeatureMatch> matches = makeScene(400, 0.0, Eigen::Vector3d::Zero(), &random).matches;
  std::vector<FeatureMatch> small = makeScene(40, 0.0, {0.02, 0.0, 0.0}, &random).matches;
  for (FeatureMatch& match : small) match.association.piece = 1;
  matches.insert(matches.end(), small.begin(), small.end());
  markOutliers(kCamera, &matches);
  const auto kept =
      std::count_if(matches.begin() + 400, matches.end(), [](const auto& m) { return m.inlier; });
  EXPECT_GT(kept, 35);
}

}  // namespace
}  // namespace softbody
