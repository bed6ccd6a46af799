#include "alignment/piece_visibility.h"

#include <gtest/gtest.h>

#include <random>

namespace softbody {
namespace {

/// Measurements of a piece: blocks and features scattered over a part of it.
struct PieceData {
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

Association somewhere(std::size_t piece, double spread, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(0.5 - 0.5 * spread, 0.5 + 0.5 * spread);
  Association association;
  association.piece = static_cast<std::uint32_t>(piece);
  const int face = static_cast<int>((*random)() % 3);
  association.normal = -Eigen::Vector3d::Unit(face);
  association.predicted = Eigen::Vector3d(uniform(*random), uniform(*random), uniform(*random)) * kSize;
  association.predicted[face] = 0.0;
  association.predicted.z() += 0.5;
  return association;
}

/// For each piece, whether it is at least so visible.
std::vector<bool> visible(const std::vector<PieceData>& pieces, Visibility least = Visibility::kPartly) {
  std::mt19937 random(5);
  SurfaceSamples samples;
  std::vector<Association> depth;
  std::vector<FeatureMatch> matches;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const PieceData& piece = pieces[p];
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.piece = static_cast<std::uint32_t>(p);
    samples.samples.insert(samples.samples.end(), static_cast<std::size_t>(piece.blocks), sample);
    for (int i = 0; i < piece.agreeing; ++i) depth.push_back(somewhere(p, piece.spread, &random));
    for (int i = 0; i < piece.inliers + piece.outliers; ++i) {
      FeatureMatch match;
      match.association = somewhere(p, piece.spread, &random);
      match.inlier = i < piece.inliers;
      matches.push_back(match);
    }
  }
  std::vector<bool> result;
  for (const Visibility piece_result :
       pieceVisibility(samples, depth, matches, std::vector<Points>(pieces.size(), cube())))
    result.push_back(piece_result >= least);
  return result;
}

constexpr PieceData kWhole{400, 390, 200, 5};

TEST(PieceVisibility, AnUncutBodyAlwaysShowsEnough) {
  EXPECT_EQ(visible({{400, 0, 0, 0}}), std::vector<bool>({true}));
}

TEST(PieceVisibility, EachPieceIsJudgedByWhatShowsOfItself) {
  EXPECT_EQ(visible({kWhole, {300, 0, 0, 0}, kWhole}), std::vector<bool>({true, false, true}));
}

TEST(PieceVisibility, ARimBesideTheBladeIsNotEnough) {
  EXPECT_EQ(visible({kWhole, {300, 60, 0, 0}}), std::vector<bool>({true, false}));
  EXPECT_EQ(visible({kWhole, {300, 100, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(PieceVisibility, OfALargePieceAHiddenPartDoesNotMatter) {
  EXPECT_EQ(visible({kWhole, {900, 200, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(PieceVisibility, ASmallPieceNeedsAFewBlocksHoweverSmallItIs) {
  EXPECT_EQ(visible({kWhole, {6, 6, 0, 0}}), std::vector<bool>({true, false}));
  EXPECT_EQ(visible({kWhole, {40, 35, 0, 0}}), std::vector<bool>({true, true}));
}

TEST(PieceVisibility, FeaturesAreEnoughWithoutDepthButOnlyThoseThatAgree) {
  EXPECT_EQ(visible({kWhole, {300, 0, 20, 0}}), std::vector<bool>({true, true}));
  EXPECT_EQ(visible({kWhole, {300, 0, 3, 40}}), std::vector<bool>({true, false}));
}

/// A few measurements close together leave the rotation undetermined.
TEST(PieceVisibility, WhatShowsMustFixTheWholePiece) {
  const auto together = [](double spread) { return std::vector<PieceData>{kWhole, {100, 90, 0, 0, spread}}; };
  EXPECT_EQ(visible(together(0.1)), std::vector<bool>({true, false}));
  EXPECT_EQ(visible(together(0.45)), std::vector<bool>({true, true}));
  EXPECT_EQ(visible(together(0.45), Visibility::kWell), std::vector<bool>({true, false}));
  EXPECT_EQ(visible(together(1.0), Visibility::kWell), std::vector<bool>({true, true}));
}

TEST(PieceVisibility, OnePlaneOfDepthDoesNotFixWhatFeaturesDo) {
  std::mt19937 random(5);
  SurfaceSamples samples;
  std::vector<Association> depth;
  std::vector<FeatureMatch> matches;
  for (int i = 0; i < 60; ++i) {
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.piece = static_cast<std::uint32_t>(i % 2);
    samples.samples.push_back(sample);
    depth.push_back(somewhere(sample.piece, 1.0, &random));
    depth.back().predicted.z() = 0.5;
    depth.back().normal = -Eigen::Vector3d::UnitZ();
    if (sample.piece == 0) continue;
    FeatureMatch match;
    match.association = depth.back();
    matches.push_back(match);
  }
  const std::vector<Visibility> result = pieceVisibility(samples, depth, matches, {cube(), cube()});
  EXPECT_EQ(result[0], Visibility::kAlmostHidden);
  EXPECT_NE(result[1], Visibility::kAlmostHidden);
}

TEST(ConfirmedPieces, AreThoseWhoseDepthAgreesNearlyEverywhere) {
  SurfaceSamples samples;
  std::vector<Association> depth;
  const int agreeing[] = {100, 80, 4};
  for (std::uint32_t body = 0; body < 3; ++body) {
    SurfaceSample sample;
    sample.position = sample.normal = Eigen::Vector3d::Zero();
    sample.piece = body;
    samples.samples.insert(samples.samples.end(), body == 2 ? 4 : 100, sample);
    Association association;
    association.piece = body;
    depth.insert(depth.end(), static_cast<std::size_t>(agreeing[body]), association);
  }
  EXPECT_EQ(confirmedPieces(samples, depth, 3), std::vector<bool>({true, false, false}));
}

}  // namespace
}  // namespace softbody
