#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "cutting/fixtures/cut_bodies.h"
#include "cutting/volume/tet_cutter.h"
#include "elasticity/elastic_blocks.h"
#include "time_step/projective_dynamics.h"

/// Strain smoothing around the vertices of a cut body: strains are not averaged across the cut.
namespace softbody {
namespace {

using testing::randomPoints;

const Lame kLame{8000.0, 5000.0};
constexpr double kSmoothing = 0.7;

/// A sponge of two layers, cut obliquely through tets and close to vertices.
TetTopology cutInTwo() {
  const TetTopology whole = testing::boxTopology({10, 5, 2}, {0.2, 0.1, 0.03});
  const std::vector<bool> uncut(static_cast<std::size_t>(whole.surface.rows()), false);
  CutStroke stroke;
  std::string reason;
  const CutPatch patch = testing::planePatch({0.093, 0.05, 0.015}, {1.0, 0.3, 0.2}, 1.0);
  const auto edit = cutTets(whole, uncut, patch, {}, &stroke, &reason);
  if (!edit) throw std::runtime_error(reason);
  return edit->topology;
}

/// A piece as a separate body. Its tets keep their order.
struct Piece {
  std::vector<int> vertices;  ///< of the cut body
  Points rest;
  Tets tets;
};

Piece pieceOf(const TetTopology& body, std::uint32_t number) {
  const auto numbers = vertexPieces(body.tets, body.tet_pieces, body.rest_vertices.rows());
  Piece piece;
  std::vector<int> place(numbers.size(), -1);
  for (std::size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] != number) continue;
    place[v] = static_cast<int>(piece.vertices.size());
    piece.vertices.push_back(static_cast<int>(v));
  }
  piece.rest = body.rest_vertices(piece.vertices, Eigen::all);
  std::vector<int> tets;
  for (std::size_t t = 0; t < body.tet_pieces.size(); ++t) {
    if (body.tet_pieces[t] == number) tets.push_back(static_cast<int>(t));
  }
  piece.tets = Tets(body.tets(tets, Eigen::all)).unaryExpr([&place](int v) { return place[v]; });
  return piece;
}

class CutElasticity : public ::testing::Test {
 protected:
  TetTopology body_ = cutInTwo();
  Eigen::Index count_ = body_.rest_vertices.rows();
  std::vector<Piece> pieces_{pieceOf(body_, 0), pieceOf(body_, 1)};
  CorotatedElasticity elasticity_{body_.rest_vertices, body_.tets, kLame, kSmoothing};
  std::mt19937 random_{5};
  Points deformed_ = body_.rest_vertices + randomPoints(count_, 5e-4, &random_);
  /// The pieces moved apart and rotated.
  std::vector<Eigen::Isometry3d> poses_{
      testing::somePose(), Eigen::Translation3d(-0.3, 0.1, 0.2) *
                               Eigen::AngleAxisd(-1.1, Eigen::Vector3d(0.3, -1.0, 2.0).normalized())};

  Points moved(Points x) const {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const std::vector<int>& vertices = pieces_[k].vertices;
      x(vertices, Eigen::all) = transformed(x(vertices, Eigen::all), poses_[k]);
    }
    return x;
  }
  double energyAt(const Points& x) const {
    Points unused = Points::Zero(count_, 3);
    return elasticity_.addTo(x, &unused);
  }
  Points gradientAt(const Points& x) const {
    Points gradient = Points::Zero(count_, 3);
    elasticity_.addTo(x, &gradient);
    return gradient;
  }
  /// The largest force of the deformed body [N].
  double force() const { return gradientAt(deformed_).rowwise().norm().maxCoeff(); }

  std::vector<int> verticesOfTheWalls() const {
    std::vector<int> walls;
    for (int v = 0; v < count_; ++v) {
      const auto same = (body_.rest_vertices.rowwise() - body_.rest_vertices.row(v)).rowwise().norm().array();
      if ((same < 1e-9).count() > 1) walls.push_back(v);
    }
    return walls;
  }
};

TEST_F(CutElasticity, IsThatOfTwoPiecesWithWallsOfVertexPairs) {
  ASSERT_EQ(*std::max_element(body_.tet_pieces.begin(), body_.tet_pieces.end()), 1u);
  EXPECT_GT(pieces_[0].tets.rows(), 200);
  EXPECT_GT(pieces_[1].tets.rows(), 200);
  EXPECT_GE(verticesOfTheWalls().size(), 2u * 6u * 3u);  // at least one pair per line of cut edges
}

TEST_F(CutElasticity, PiecesTurnAndMoveFreely) {
  const Points x = moved(body_.rest_vertices);
  EXPECT_NEAR(energyAt(x), 0.0, 1e-12 * energyAt(deformed_));
  EXPECT_LT(gradientAt(x).cwiseAbs().maxCoeff(), 1e-9 * force());
}

TEST_F(CutElasticity, NoForceGoesFromPieceToPiece) {
  const Points x = moved(deformed_);
  const Points gradient = gradientAt(x);
  double sum = 0.0;
  for (const Piece& piece : pieces_) {
    const CorotatedElasticity alone(piece.rest, piece.tets, kLame, kSmoothing);
    const Points there = x(piece.vertices, Eigen::all), here = gradient(piece.vertices, Eigen::all);
    Points expected = Points::Zero(there.rows(), 3);
    sum += alone.addTo(there, &expected);
    EXPECT_LT((here - expected).cwiseAbs().maxCoeff(), 1e-9 * force());
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (Eigen::Index v = 0; v < here.rows(); ++v)
      moment += Eigen::Vector3d(there.row(v)).cross(Eigen::Vector3d(here.row(v)));
    EXPECT_LT(here.colwise().sum().norm(), 1e-9 * force());
    EXPECT_LT(moment.norm(), 1e-9 * force());
  }
  EXPECT_NEAR(energyAt(x), sum, 1e-12 * sum);
  EXPECT_NEAR(energyAt(x), energyAt(deformed_), 1e-9 * sum);
}

/// In random directions, and for every coordinate of some vertices on the walls of the cut.
TEST_F(CutElasticity, GradientMatchesDifferences) {
  const Points x = moved(deformed_), gradient = gradientAt(x);
  std::vector<Points> directions;
  for (int k = 0; k < 5; ++k) directions.push_back(randomPoints(count_, 1.0, &random_));
  const std::vector<int> walls = verticesOfTheWalls();
  for (std::size_t w = 0; w < walls.size(); w += 7) {
    for (int k = 0; k < 3; ++k) {
      directions.emplace_back(Points::Zero(count_, 3));
      directions.back()(walls[w], k) = 1.0;
    }
  }
  constexpr double kStep = 1e-7;
  for (const Points& direction : directions) {
    const double difference =
        (energyAt(x + kStep * direction) - energyAt(x - kStep * direction)) / (2.0 * kStep);
    EXPECT_NEAR(difference, gradient.cwiseProduct(direction).sum(), 1e-6 * force() * direction.norm());
  }
}

TEST_F(CutElasticity, VectorKernelsLetPiecesTurnFreelyToo) {
  ElasticBlocks<double> blocks(body_.rest_vertices, elasticity_, Simd::kAuto);
  Rows<double> x = Rows<double>::Zero(paddedRows(count_), 4), gradient = x;
  x.topLeftCorner(count_, 3) = moved(body_.rest_vertices);
  EXPECT_NEAR(blocks.addTo(x, &gradient), 0.0, 1e-12 * energyAt(deformed_));
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9 * force());
}

/// A time step that moves the pieces apart, with rotation, is a rigid motion of each.
TEST_F(CutElasticity, PiecesInFlightGoWhereTheirInertiaTakesThem) {
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::Constant(count_, 1.0);
  potential.prediction = moved(body_.rest_vertices);
  potential.loads = Points::Zero(count_, 3);
  ProjectiveDynamicsOptions options;
  options.minimizer.max_iterations = 500;
  options.minimizer.tolerance = 1e-9;
  Points x = potential.prediction + randomPoints(count_, 2e-3, &random_);
  ProjectiveDynamics(body_, {kLame, kSmoothing}, options).minimize(potential, &x);
  EXPECT_LT((x - potential.prediction).cwiseAbs().maxCoeff(), 1e-7);
}

}  // namespace
}  // namespace softbody
