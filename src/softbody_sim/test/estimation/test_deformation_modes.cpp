#include "estimation/deformation_modes.h"

#include <gtest/gtest.h>

#include <optional>

#include "elasticity/fem_elasticity.h"
#include "elasticity/tet_materials.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

struct Body {
  explicit Body(const TetTopology& topology_in) : topology(topology_in) {}

  const TetTopology topology;
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(topology.rest_vertices.rows(), 1e-3, 2e-3);
  const TetMaterials materials = tetMaterials(topology, Material(), 0.7, std::nullopt);

  DeformationModes modes(Eigen::Index count) const {
    return deformationModes(topology, materials.elastic, masses, count);
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

}  // namespace
}  // namespace softbody
