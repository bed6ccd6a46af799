#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "softbody_evaluation/measures/vertex_error.h"
#include "softbody_evaluation/measures/vertex_match.h"

namespace softbody::evaluation {
namespace {

/// Two squares side by side along x, each of two triangles; cut apart, the seam's two vertices are doubled.
MeshTopology strip(bool cut) {
  MeshTopology mesh;
  mesh.revision = cut ? 1 : 0;
  mesh.rest_vertices.resize(cut ? 8 : 6, 3);
  mesh.rest_vertices.topRows(6) << 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0;
  mesh.vertex_parents = {0, 1, 2, 3, 4, 5};
  mesh.triangles.resize(4, 3);
  const int a = cut ? 6 : 2, b = cut ? 7 : 3;
  mesh.triangles << 0, 2, 3, 0, 3, 1, a, 4, 5, a, 5, b;
  mesh.triangle_pieces = {0, 0, cut ? 1u : 0u, cut ? 1u : 0u};
  mesh.cut.assign(4, false);
  if (cut) {
    mesh.rest_vertices.bottomRows(2) = mesh.rest_vertices.middleRows(2, 2);
    mesh.vertex_parents.insert(mesh.vertex_parents.end(), {2, 3});
  }
  return mesh;
}

/// The same mesh with its vertices and pieces in another order.
MeshTopology shuffled(const MeshTopology& mesh, const std::vector<int>& order) {
  MeshTopology result = mesh;
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.rest_vertices.row(order[i]) = mesh.rest_vertices.row(static_cast<Eigen::Index>(i));
    result.vertex_parents[static_cast<std::size_t>(order[i])] = mesh.vertex_parents[i];
  }
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      result.triangles(f, k) = order[static_cast<std::size_t>(mesh.triangles(f, k))];
  }
  for (std::uint32_t& body : result.triangle_pieces) body = 1 - body;
  return result;
}

TEST(SameMesh, WhatCutsCopiedAndWeldingLeftOutIsTheSame) {
  const MeshTopology whole = strip(false);
  EXPECT_TRUE(sameMesh(whole, whole));
  EXPECT_TRUE(sameMesh(strip(true), whole));
  EXPECT_TRUE(sameMesh(whole, strip(true)));
  EXPECT_TRUE(sameMesh(shuffled(strip(true), {3, 1, 4, 0, 7, 6, 2, 5}), strip(true)));
  MeshTopology welded = whole;
  welded.rest_vertices.row(5).setConstant(9.0);
  EXPECT_FALSE(sameMesh(welded, whole));
  welded.vertex_parents[5] = 17;  // another vertex of the file stands for it
  EXPECT_TRUE(sameMesh(welded, whole));
}

TEST(SameMesh, NothingInCommonOrAnotherPlaceIsAnother) {
  const MeshTopology truth = strip(false);
  MeshTopology mesh = truth;
  mesh.vertex_parents.assign(6, -1);
  EXPECT_FALSE(sameMesh(mesh, truth));
  mesh = truth;
  mesh.rest_vertices(4, 1) += 1e-4;
  EXPECT_FALSE(sameMesh(mesh, truth));
  EXPECT_FALSE(sameMesh(truth, MeshTopology()));
}

/// Messages carry float: far from its origin a mesh comes back rounded by more than a millionth of its size.
TEST(SameMesh, WhatMessagesRoundIsTheSame) {
  MeshTopology mesh = strip(false);
  mesh.rest_vertices = 0.1 * mesh.rest_vertices.array() + 70.0 / 3.0;
  MeshTopology truth = mesh;
  truth.rest_vertices = mesh.rest_vertices.cast<float>().cast<double>();
  ASSERT_GT((truth.rest_vertices - mesh.rest_vertices).norm(), 1e-6);
  EXPECT_TRUE(sameMesh(mesh, truth));
  truth.rest_vertices.col(0).array() += 1e-4;
  EXPECT_FALSE(sameMesh(mesh, truth));
}

TEST(VertexMatch, CopiesAreMatchedToTheirOwnSideInAnyOrder) {
  const MeshTopology truth = strip(true);
  std::vector<int> order{0, 1, 2, 3, 4, 5, 6, 7};
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    const MeshTopology result = shuffled(truth, order);
    const std::vector<int> matches = matchVertices(result, truth, 0.002);
    for (std::size_t i = 0; i < order.size(); ++i)
      EXPECT_EQ(matches[static_cast<std::size_t>(order[i])], static_cast<int>(i));
    const PieceMatch pieces = matchPieces(result, truth, matches);
    EXPECT_EQ(pieces.true_piece, (std::vector<int>{1, 0}));
    EXPECT_EQ(pieces.vertices_right, 1.0);
  }
}

TEST(VertexMatch, WithoutACutItIsTheMatchByParents) {
  const MeshTopology mesh = strip(false);
  EXPECT_EQ(matchVertices(mesh, mesh, 0.002), matchVertices(mesh.vertex_parents, mesh.vertex_parents));
}

TEST(VertexMatch, VerticesMadeByACutStandForTheNearestSuchOneIfItIsNear) {
  MeshTopology result = strip(false), truth = strip(false);
  result.vertex_parents[2] = truth.vertex_parents[3] = truth.vertex_parents[2] = -1;
  result.rest_vertices(2, 1) = 0.001;
  EXPECT_EQ(matchVertices(result, truth, 0.002)[2], 2);
  EXPECT_EQ(matchVertices(result, truth, 0.0005)[2], -1);
}

/// A vertex on a cut's rim, once for each side: a fan of the wall below it, which faces the other side, and
/// of the top beside it. Its sizes and angles are random.
MeshTopology rim(std::mt19937* random) {
  constexpr int kFan = 3;
  std::uniform_real_distribution<double> radius(0.005, 0.04), part(0.1, 1.0);
  std::vector<Eigen::RowVector3d> vertices{{0, 0, 0}, {0, 0, 0}};
  std::vector<Eigen::RowVector3i> triangles;
  MeshTopology mesh;
  for (int side = 0; side < 2; ++side) {
    const double beside = side == 0 ? -1.0 : 1.0;
    for (const bool wall : {true, false}) {
      for (int k = 0; k <= kFan; ++k) {
        const double angle = M_PI * (k == 0 ? 0.0 : (k - 1 + part(*random)) / kFan), r = radius(*random);
        vertices.emplace_back(wall ? 0.0 : beside * r * std::sin(angle), r * std::cos(angle),
                              wall ? -r * std::sin(angle) : 0.0);
        if (k == 0) continue;
        const int last = static_cast<int>(vertices.size()) - 1;
        const bool turned = (side == 0) == wall;
        triangles.emplace_back(side, turned ? last : last - 1, turned ? last - 1 : last);
        mesh.triangle_pieces.push_back(static_cast<std::uint32_t>(side));
        mesh.cut.push_back(wall);
      }
    }
  }
  mesh.rest_vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v) mesh.rest_vertices.row(v) = vertices[v];
  for (std::size_t f = 0; f < triangles.size(); ++f) mesh.triangles.row(f) = triangles[f];
  mesh.vertex_parents.assign(vertices.size(), -1);
  return mesh;
}

TEST(VertexMatch, ACutsRimIsMatchedToItsOwnSideHoweverBothAreTriangulated) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const MeshTopology result = rim(&random), truth = rim(&random);
    const std::vector<int> matches = matchVertices(result, truth, 1e-6);
    EXPECT_EQ(matches[0], 0);
    EXPECT_EQ(matches[1], 1);
  }
}

TEST(VertexMatch, ACopyThatLooksLikeAnotherSidesIsKnownByItsPiece) {
  const MeshTopology truth = strip(true);
  MeshTopology result = truth;
  result.rest_vertices(4, 0) = result.rest_vertices(5, 0) = -3.0;  // folded over to the other side
  const std::vector<int> matches = matchVertices(result, truth, 0.002);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(matches[static_cast<std::size_t>(i)], i);
}

TEST(VertexMatch, AMissedCutLeavesHalfTheVerticesInTheWrongPiece) {
  const MeshTopology result = strip(false), truth = strip(true);
  const PieceMatch pieces = matchPieces(result, truth, matchVertices(result, truth, 0.002));
  EXPECT_EQ(pieces.result_pieces, 1u);
  EXPECT_EQ(pieces.true_pieces, 2u);
  // Six vertices: those of one square, at least, are in the piece that the only one stands for.
  EXPECT_NEAR(pieces.vertices_right, 0.5, 0.17);
}

TEST(NearCut, OnlyVerticesWithinTheDistanceOfACutTriangle) {
  MeshTopology mesh = strip(false);
  mesh.cut = {true, false, false, false};  // its corners are 0, 2 and 3
  EXPECT_EQ(nearCut(mesh, 0.5), (std::vector<bool>{true, false, true, true, false, false}));
  EXPECT_EQ(nearCut(mesh, 1.0), (std::vector<bool>{true, true, true, true, true, true}));
  mesh.cut.assign(4, false);
  EXPECT_EQ(nearCut(mesh, 9.0), std::vector<bool>(6, false));
}

TEST(VertexError, NearACutHasItsOwnRowAndUnmatchedVerticesAreCounted) {
  MeshState truth, result;
  truth.vertices = strip(false).rest_vertices;
  truth.confidence.assign(6, 1.0f);
  result = truth;
  result.vertices(0, 2) += 0.003;
  result.vertices(1, 2) += 0.001;
  const FrameVertexError frame =
      vertexError(result, truth, {0, 1, 2, 3, 4, -1}, {{true, false, false, false, false, true}, {}, {}});
  const VertexErrorReport report = summarize(std::vector<FrameVertexError>{frame});
  EXPECT_EQ(report.near_cut.count, 1u);
  EXPECT_NEAR(report.near_cut.mean, 0.003, 1e-9);
  EXPECT_EQ(report.all.count, 5u);
  EXPECT_NEAR(report.unmatched_share, 1.0 / 6.0, 1e-12);
}

TEST(VertexError, EveryTruePieceHasItsOwnRowWhereThereAreSeveral) {
  const MeshTopology topology = strip(true);
  MeshState truth, result;
  truth.vertices = topology.rest_vertices;
  truth.confidence.assign(8, 1.0f);
  result = truth;
  const std::vector<int> pieces = vertexPieces(topology);
  for (Eigen::Index i = 0; i < 8; ++i)
    result.vertices(i, 2) += pieces[static_cast<std::size_t>(i)] == 0 ? 0.001 : 0.004;
  const std::vector<int> matches = matchVertices(topology, topology, 0.002);
  const VertexErrorReport report =
      summarize(std::vector<FrameVertexError>{vertexError(result, truth, matches, {{}, {}, pieces})});
  ASSERT_EQ(report.pieces.size(), 2u);
  EXPECT_NEAR(report.pieces[0].max, 0.001, 1e-9);
  EXPECT_NEAR(report.pieces[1].mean, 0.004, 1e-9);
  EXPECT_EQ(report.pieces[1].count, 4u);
  const MeshTopology whole = strip(false);
  truth.vertices = result.vertices = whole.rest_vertices;
  truth.confidence.assign(6, 1.0f);
  const FrameVertexError frame =
      vertexError(result, truth, matchVertices(whole, whole, 0.002), {{}, {}, vertexPieces(whole)});
  EXPECT_TRUE(summarize(std::vector<FrameVertexError>{frame}).pieces.empty());
}

TEST(VertexError, CoveredAreTheHiddenOnesThatWereSeenAtFirst) {
  MeshState truth, result;
  truth.vertices = strip(false).rest_vertices;
  truth.confidence = {1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f};
  result = truth;
  result.vertices(1, 2) += 0.005;
  result.vertices(2, 2) += 0.002;
  const std::vector<bool> seen{true, true, false, true, true, false};
  const FrameVertexError frame = vertexError(result, truth, {0, 1, 2, 3, 4, 5}, {{}, seen, {}});
  ASSERT_EQ(frame.covered.size(), 1u);
  EXPECT_NEAR(frame.covered[0], 0.005f, 1e-9);
}

}  // namespace
}  // namespace softbody::evaluation
