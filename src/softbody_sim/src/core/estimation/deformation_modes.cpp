#include "estimation/deformation_modes.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <vector>

#include "elasticity/fem_elasticity.h"
#include "softbody_common/tet_geometry.h"
#include "tets/block_tet_matrix.h"

namespace softbody {
namespace {

// Iterations of the subspace; the start is smooth already, and the modes need not be exact.
constexpr int kIterations = 2;
// Degree of the polynomials of the start: the lowest modes of a compact body are like these.
constexpr int kDegree = 4;

/// Three displacements for each monomial of a piece's rest coordinates: 3 #V by columns.
Eigen::MatrixXd smoothDisplacements(const Points& rest, const std::vector<int>& piece) {
  std::vector<Eigen::Vector3i> powers;
  for (int sum = 0; sum <= kDegree; ++sum)
    for (int i = 0; i <= sum; ++i)
      for (int j = 0; i + j <= sum; ++j) powers.emplace_back(i, j, sum - i - j);
  const Points places = rest(piece, Eigen::all);
  const Eigen::RowVector3d low = places.colwise().minCoeff(), high = places.colwise().maxCoeff();
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(3 * rest.rows(), 3 * static_cast<Eigen::Index>(powers.size()));
  for (const int v : piece) {
    const Eigen::Array3d at = ((2.0 * rest.row(v) - low - high).array() / (high - low).array()).transpose();
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const double value = at.pow(powers[k].cast<double>().array()).prod();
      for (int axis = 0; axis < 3; ++axis)
        result(3 * v + axis, 3 * static_cast<Eigen::Index>(k) + axis) = value;
    }
  }
  return result;
}

/// The lowest modes in a space of displacements (Rayleigh and Ritz), rigid ones first.
DeformationModes lowestIn(const Eigen::MatrixXd& displacements, const Eigen::SparseMatrix<double>& K,
                          const Eigen::VectorXd& mass) {
  const Eigen::MatrixXd M = displacements.transpose() * mass.asDiagonal() * displacements;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_mass(M);
  const Eigen::VectorXd& scale = of_mass.eigenvalues();
  const Eigen::Index rank = (scale.array() > 1e-10 * scale[scale.size() - 1]).count();
  const Eigen::MatrixXd orthonormal = displacements * of_mass.eigenvectors().rightCols(rank) *
                                      scale.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd force = K.selfadjointView<Eigen::Lower>() * orthonormal;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(orthonormal.transpose() * force);
  return {orthonormal * modes.eigenvectors(), modes.eigenvalues()};
}

DeformationModes lowest(Eigen::Index count, const DeformationModes& modes) {
  count = std::min(count, modes.stiffness.size());
  return {modes.shapes.leftCols(count), modes.stiffness.head(count)};
}

void append(const Eigen::MatrixXd& shapes, const Eigen::VectorXd& stiffness, DeformationModes* modes) {
  const Eigen::Index before = modes->stiffness.size();
  modes->shapes.conservativeResize(Eigen::NoChange, before + stiffness.size());
  modes->shapes.rightCols(stiffness.size()) = shapes;
  modes->stiffness.conservativeResize(before + stiffness.size());
  modes->stiffness.tail(stiffness.size()) = stiffness;
}

}  // namespace

DeformationModes deformationModes(const TetTopology& topology, const ElasticMaterials& materials,
                                  const Eigen::VectorXd& masses, Eigen::Index count) {
  constexpr Eigen::Index kRigid = 6;
  const FemElasticity elasticity(topology, Elasticity::kCorotated, materials);
  BlockTetMatrix matrix(elasticity.groups(), masses.size());
  elasticity.addHessian(topology.rest_vertices, &matrix);
  const Eigen::SparseMatrix<double>& K = matrix.lower();
  const Eigen::VectorXd mass = masses.transpose().replicate(3, 1).reshaped();
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  DeformationModes all{Eigen::MatrixXd(mass.size(), 0), Eigen::VectorXd(0)};
  for (const std::vector<int>& piece : verticesOfPieces(topology.tets, masses.size())) {
    const Eigen::Index share =
        std::max<Eigen::Index>(kRigid, count * static_cast<Eigen::Index>(piece.size()) / masses.size());
    DeformationModes modes = lowest(kRigid + share + share / 4,
                                    lowestIn(smoothDisplacements(topology.rest_vertices, piece), K, mass));
    if (modes.stiffness.size() <= kRigid) continue;
    if (solver.rows() == 0) {  // with a shift, so that rigid modes can be solved for
      Eigen::SparseMatrix<double> shifted = K;
      shifted.diagonal() += modes.stiffness[kRigid] * mass;
      solver.compute(shifted);
    }
    for (int i = 0; i < kIterations; ++i)
      modes = lowestIn(solver.solve(mass.asDiagonal() * modes.shapes), K, mass);
    modes = lowest(kRigid + share, modes);
    append(modes.shapes.rightCols(modes.shapes.cols() - kRigid),
           modes.stiffness.tail(modes.stiffness.size() - kRigid), &all);
  }
  return all;
}

}  // namespace softbody
