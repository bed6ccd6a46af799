#include "estimation/deformation_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "elasticity/tet_materials.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

/// The modes of all pieces, as motions of the body: 3 #V by #modes.
DeformationModes joined(const TetTopology& topology, const std::vector<DeformationModes>& modes) {
  const auto pieces = verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  Eigen::Index count = 0;
  for (const DeformationModes& piece : modes) count += piece.stiffness.size();
  DeformationModes all{Eigen::MatrixXd::Zero(3 * topology.rest_vertices.rows(), count),
                       Eigen::VectorXd(count)};
  Eigen::Index first = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Eigen::Index own = modes[p].stiffness.size();
    all.stiffness.segment(first, own) = modes[p].stiffness;
    for (std::size_t k = 0; k < pieces[p].size(); ++k)
      all.shapes.block(3 * pieces[p][k], first, 3, own) =
          modes[p].shapes.middleRows(3 * static_cast<Eigen::Index>(k), 3);
    first += own;
  }
  return all;
}

struct Body {
  explicit Body(const TetTopology& topology_in) : topology(topology_in) {}

  const TetTopology topology;
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(topology.rest_vertices.rows(), 1e-3, 2e-3);
  const TetMaterials materials = tetMaterials(topology, Material(), 0.7, std::nullopt);

  DeformationModes modes(Eigen::Index count) const {
    return joined(topology, deformationModes(topology, materials.elastic, masses, count));
  }
  Eigen::MatrixXd gram(const Eigen::MatrixXd& shapes) const {
    const Eigen::VectorXd mass = masses.transpose().replicate(3, 1).reshaped();
    return shapes.transpose() * mass.asDiagonal() * shapes;
  }
};

TEST(DeformationModes, AreOrthonormalByMassAndAscend) {
  const Body body(testing::boxTopology({6, 3, 2}, {0.2, 0.1, 0.04}));
  const DeformationModes modes = body.modes(20);
  ASSERT_EQ(modes.stiffness.size(), 20);
  EXPECT_TRUE(body.gram(modes.shapes).isIdentity(1e-8));
  EXPECT_GT(modes.stiffness[0], 0.0);
  for (Eigen::Index i = 1; i < 20; ++i) EXPECT_GE(modes.stiffness[i], modes.stiffness[i - 1]);
}

/// The elastic energy of a small motion along a mode is w^2 / 2 of its amplitude squared.
TEST(DeformationModes, HaveTheStiffnessOfTheBody) {
  const Body body(testing::boxTopology({6, 3, 2}, {0.2, 0.1, 0.04}));
  const DeformationModes modes = body.modes(20);
  const FemElasticity elasticity(body.topology, Elasticity::kCorotated, body.materials.elastic);
  for (const Eigen::Index mode : {0, 3, 10}) {
    const double amplitude = 1e-5 / modes.shapes.col(mode).cwiseAbs().maxCoeff();
    const Points moved = body.topology.rest_vertices +
                         amplitude * modes.shapes.col(mode).reshaped<Eigen::RowMajor>(body.masses.size(), 3);
    Points gradient = Points::Zero(moved.rows(), 3);
    EXPECT_NEAR(elasticity.addTo(moved, &gradient), 0.5 * modes.stiffness[mode] * amplitude * amplitude,
                0.02 * 0.5 * modes.stiffness[mode] * amplitude * amplitude);
  }
}

TEST(DeformationModes, MoveNoPieceRigidly) {
  const Body body(testing::twoBoxes({4, 3, 2}, {0.2, 0.1, 0.04}));
  const DeformationModes modes = body.modes(20);
  Eigen::MatrixXd rigid(3 * body.masses.size(), 3);
  for (Eigen::Index row = 0; row < rigid.rows(); ++row) rigid.row(row) = Eigen::RowVector3d::Unit(row % 3);
  const Eigen::VectorXd mass = body.masses.transpose().replicate(3, 1).reshaped();
  EXPECT_LT((rigid.transpose() * mass.asDiagonal() * modes.shapes).norm(), 1e-8 * modes.shapes.norm());
  // Each moves one piece only.
  const Eigen::Index half = rigid.rows() / 2;
  for (const auto& shape : modes.shapes.colwise())
    EXPECT_LT(std::min(shape.head(half).norm(), shape.tail(half).norm()), 1e-9 * shape.norm());
}

TetTopology sideBySide(const TetTopology& left, const TetTopology& right) {
  const Eigen::Index count = left.rest_vertices.rows();
  TetTopology both;
  both.rest_vertices.resize(count + right.rest_vertices.rows(), 3);
  both.rest_vertices << left.rest_vertices, right.rest_vertices.rowwise() + Eigen::RowVector3d(1.0, 0.0, 0.0);
  both.tets.resize(left.tets.rows() + right.tets.rows(), 4);
  both.tets << left.tets, (right.tets.array() + static_cast<int>(count)).matrix();
  return both;
}

/// The modes of a piece are its own, whatever else is there.
TEST(DeformationModes, DoNotDependOnTheOrderOfPieces) {
  const TetTopology beam = testing::boxTopology({8, 4, 2}, {0.4, 0.1, 0.04}),
                    cube = testing::boxTopology({2, 2, 2}, {0.1, 0.1, 0.1});
  const auto stiffness = [](const TetTopology& topology) {
    const TetMaterials materials = tetMaterials(topology, Material(), 0.7, std::nullopt);
    const Eigen::VectorXd masses = Eigen::VectorXd::Constant(topology.rest_vertices.rows(), 1e-3);
    Eigen::VectorXd result =
        joined(topology, deformationModes(topology, materials.elastic, masses, 60)).stiffness;
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_TRUE(stiffness(sideBySide(cube, beam)).isApprox(stiffness(sideBySide(beam, cube)), 1e-6));
}

}  // namespace
}  // namespace softbody
