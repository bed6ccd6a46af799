#include <gtest/gtest.h>

#include "core/shown_pieces.h"

namespace softbody {
namespace {

/// What a frame shows of each piece.
struct Shown {
  int blocks, agreeing, inliers, outliers;
};

std::vector<bool> shownPieces(const std::vector<Shown>& pieces) {
  SurfaceSamples samples;
  std::vector<Association> depth;
  std::vector<FeatureMatch> matches;
  for (std::size_t body = 0; body < pieces.size(); ++body) {
    SurfaceSample sample;
    Association association;
    FeatureMatch match;
    sample.body = association.body = match.association.body = static_cast<std::uint32_t>(body);
    samples.samples.insert(samples.samples.end(), static_cast<std::size_t>(pieces[body].blocks), sample);
    depth.insert(depth.end(), static_cast<std::size_t>(pieces[body].agreeing), association);
    matches.insert(matches.end(), static_cast<std::size_t>(pieces[body].inliers), match);
    match.inlier = false;
    matches.insert(matches.end(), static_cast<std::size_t>(pieces[body].outliers), match);
  }
  return softbody::shownPieces(samples, depth, matches, pieces.size());
}

constexpr Shown kWhole{400, 390, 200, 5};

TEST(ShownPieces, AnUncutBodyAlwaysShowsEnough) {
  EXPECT_EQ(shownPieces({{400, 0, 0, 0}}), std::vector<bool>({true}));
}

TEST(ShownPieces, EachPieceIsJudgedByWhatShowsOfItself) {
  EXPECT_EQ(shownPieces({kWhole, {300, 0, 0, 0}, kWhole}), std::vector<bool>({true, false, true}));
}

TEST(ShownPieces, ARimBesideTheBladeIsNotEnough) {
  EXPECT_EQ(shownPieces({kWhole, {300, 60, 0, 0}}), std::vector<bool>({true, false}));
  EXPECT_EQ(shownPieces({kWhole, {300, 100, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(ShownPieces, OfALargePieceAHiddenPartDoesNotMatter) {
  EXPECT_EQ(shownPieces({kWhole, {900, 200, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(ShownPieces, ASmallPieceNeedsAFewBlocksHoweverSmallItIs) {
  EXPECT_EQ(shownPieces({kWhole, {6, 6, 0, 0}}), std::vector<bool>({true, false}));
  EXPECT_EQ(shownPieces({kWhole, {20, 15, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(ShownPieces, FeaturesAreEnoughWithoutDepthButOnlyThoseThatAgree) {
  EXPECT_EQ(shownPieces({kWhole, {300, 0, 20, 0}}), std::vector<bool>({true, true}));
  EXPECT_EQ(shownPieces({kWhole, {300, 0, 3, 40}}), std::vector<bool>({true, false}));
}

}  // namespace
}  // namespace softbody
