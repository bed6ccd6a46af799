#include "alignment/shown_pieces.h"

#include <gtest/gtest.h>

#include <random>

namespace softbody {
namespace {

/// What a frame shows of each piece: blocks and features scattered over a part of it.
struct Shown {
  int blocks, agreeing, inliers, outliers;
  double spread = 1.0;  ///< of what shows, of the piece's size
};

constexpr double kSize = 0.05;  // [m]

Points cube() {
  Points corners(8, 3);
  for (int c = 0; c < 8; ++c)
    corners.row(c) =
        Eigen::RowVector3d(c & 1, c >> 1 & 1, c >> 2 & 1) * kSize + Eigen::RowVector3d(0, 0, 0.5);
  return corners;
}

Association somewhere(std::size_t body, double spread, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(0.5 - 0.5 * spread, 0.5 + 0.5 * spread);
  Association association;
  association.body = static_cast<std::uint32_t>(body);
  const int face = static_cast<int>((*random)() % 3);
  association.normal = -Eigen::Vector3d::Unit(face);
  association.predicted = Eigen::Vector3d(uniform(*random), uniform(*random), uniform(*random)) * kSize;
  association.predicted[face] = 0.0;
  association.predicted.z() += 0.5;
  return association;
}

/// Whether each shows at all.
std::vector<bool> shownPieces(const std::vector<Shown>& pieces, Shows least = Shows::kLoosely) {
  std::mt19937 random(5);
  SurfaceSamples samples;
  std::vector<Association> depth;
  std::vector<FeatureMatch> matches;
  for (std::size_t body = 0; body < pieces.size(); ++body) {
    const Shown& piece = pieces[body];
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.body = static_cast<std::uint32_t>(body);
    samples.samples.insert(samples.samples.end(), static_cast<std::size_t>(piece.blocks), sample);
    for (int i = 0; i < piece.agreeing; ++i) depth.push_back(somewhere(body, piece.spread, &random));
    for (int i = 0; i < piece.inliers + piece.outliers; ++i) {
      FeatureMatch match;
      match.association = somewhere(body, piece.spread, &random);
      match.inlier = i < piece.inliers;
      matches.push_back(match);
    }
  }
  std::vector<bool> result;
  for (const Shows shows :
       softbody::shownPieces(samples, depth, matches, std::vector<Points>(pieces.size(), cube())))
    result.push_back(shows >= least);
  return result;
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
  EXPECT_EQ(shownPieces({kWhole, {40, 35, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(ShownPieces, FeaturesAreEnoughWithoutDepthButOnlyThoseThatAgree) {
  EXPECT_EQ(shownPieces({kWhole, {300, 0, 20, 0}}), std::vector<bool>({true, true}));
  EXPECT_EQ(shownPieces({kWhole, {300, 0, 3, 40}}), std::vector<bool>({true, false}));
}

/// A few of them together would turn it any way.
TEST(ShownPieces, WhatShowsMustFixTheWholePiece) {
  const auto together = [](double spread) { return std::vector<Shown>{kWhole, {100, 90, 0, 0, spread}}; };
  EXPECT_EQ(shownPieces(together(0.1)), std::vector<bool>({true, false}));
  EXPECT_EQ(shownPieces(together(0.45)), std::vector<bool>({true, true}));
  EXPECT_EQ(shownPieces(together(0.45), Shows::kWell), std::vector<bool>({true, false}));
  EXPECT_EQ(shownPieces(together(1.0), Shows::kWell), std::vector<bool>({true, true}));
}

TEST(ShownPieces, OnePlaneOfDepthDoesNotFixWhatFeaturesDo) {
  std::mt19937 random(5);
  SurfaceSamples samples;
  std::vector<Association> depth;
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < 60; ++i) {
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.body = static_cast<std::uint32_t>(i % 2);
    samples.samples.push_back(sample);
    depth.push_back(somewhere(sample.body, 1.0, &random));
    depth.back().predicted.z() = 0.5;
    depth.back().normal = -Eigen::Vector3d::UnitZ();
    if (sample.body == 0) continue;
    FeatureMatch match;
    match.association = depth.back();
    matches.push_back(match);
  }
  const std::vector<Shows> shown = softbody::shownPieces(samples, depth, matches, {cube(), cube()});
  EXPECT_EQ(shown[0], Shows::kHardly);
  EXPECT_NE(shown[1], Shows::kHardly);
}

TEST(ConfirmedPieces, AreThoseWhoseDepthAgreesNearlyEverywhere) {
  SurfaceSamples samples;
  std::vector<Association> depth;
  const int agreeing[] = {100, 80, 4};
  for (std::uint32_t body = 0; body < 3; ++body) {
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.body = body;
    samples.samples.insert(samples.samples.end(), body == 2 ? 4 : 100, sample);
    Association association;
    association.body = body;
    depth.insert(depth.end(), static_cast<std::size_t>(agreeing[body]), association);
  }
  EXPECT_EQ(confirmedPieces(samples, depth, 3), std::vector<bool>({true, false, false}));
}

}  // namespace
}  // namespace softbody
