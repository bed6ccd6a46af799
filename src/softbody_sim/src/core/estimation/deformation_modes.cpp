#include "estimation/deformation_modes.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "fem/fem_elasticity.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "tets/block_tet_matrix.h"

namespace softbody {
namespace {

// Iterations of the subspace; the start is smooth already, and the modes need not be exact.
constexpr int kIterations = 2;
// Degree of the polynomials of the start: the lowest modes of a compact body are like these.
constexpr int kDegree = 4;

constexpr Eigen::Index kRigid = 6;  // modes of a piece

/// Three displacements for each monomial of a piece's rest coordinates: 3 #V by columns.
Eigen::MatrixXd smoothDisplacements(const Points& rest) {
  std::vector<Eigen::Vector3i> powers;
  for (int sum = 0; sum <= kDegree; ++sum)
    for (int i = 0; i <= sum; ++i)
      for (int j = 0; i + j <= sum; ++j) powers.emplace_back(i, j, sum - i - j);
  const Eigen::RowVector3d low = rest.colwise().minCoeff(), high = rest.colwise().maxCoeff();
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(3 * rest.rows(), 3 * static_cast<Eigen::Index>(powers.size()));
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
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

/// Those of one piece, without rigid ones. @param K lower triangle.
DeformationModes modesOfPiece(const Points& rest, const Eigen::SparseMatrix<double>& K,
                              const Eigen::VectorXd& mass, Eigen::Index count) {
  DeformationModes modes = lowest(kRigid + count + count / 4, lowestIn(smoothDisplacements(rest), K, mass));
  if (modes.stiffness.size() <= kRigid) return {Eigen::MatrixXd(mass.size(), 0), Eigen::VectorXd(0)};
  Eigen::SparseMatrix<double> shifted = K;  // so that rigid modes can be solved for
  shifted.diagonal() += modes.stiffness[kRigid] * mass;
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> solver;
  solver.cholmod().print = 0;
  solver.cholmod().nmethods = 1;  // else CHOLMOD may try METIS, which draws random numbers of the process
  solver.cholmod().method[0].ordering = CHOLMOD_AMD;
  solver.compute(shifted);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the stiffness of the body is not positive");
  for (int i = 0; i < kIterations; ++i)
    modes = lowestIn(solver.solve(Eigen::MatrixXd(mass.asDiagonal() * modes.shapes)), K, mass);
  modes = lowest(kRigid + count, modes);
  const Eigen::Index found = modes.stiffness.size() - kRigid;
  return {modes.shapes.rightCols(found), modes.stiffness.tail(found)};
}

/// The part of a matrix that belongs to a piece, which is coupled with no other. @param lower triangle.
Eigen::SparseMatrix<double> partOf(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& piece) {
  std::vector<int> local(static_cast<std::size_t>(lower.rows() / 3), -1);
  for (std::size_t i = 0; i < piece.size(); ++i)
    local[static_cast<std::size_t>(piece[i])] = static_cast<int>(i);
  const auto at = [&](Eigen::Index row) {
    return 3 * local[static_cast<std::size_t>(row / 3)] + static_cast<int>(row % 3);
  };
  std::vector<Eigen::Triplet<double>> entries;
  for (const int v : piece) {
    for (Eigen::Index column = 3 * v; column < 3 * v + 3; ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, column); entry; ++entry)
        entries.emplace_back(std::max(at(entry.row()), at(column)), std::min(at(entry.row()), at(column)),
                             entry.value());
    }
  }
  const auto size = 3 * static_cast<Eigen::Index>(piece.size());
  Eigen::SparseMatrix<double> part(size, size);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

}  // namespace

std::vector<DeformationModes> deformationModes(const TetTopology& topology, const ElasticMaterials& materials,
                                               const Eigen::VectorXd& masses, Eigen::Index count) {
  const FemElasticity elasticity(topology, Elasticity::kCorotated, materials);
  BlockTetMatrix matrix(elasticity.groups(), masses.size());
  elasticity.addHessian(topology.rest_vertices, &matrix);
  std::vector<DeformationModes> modes;
  for (const std::vector<int>& piece : verticesOfPieces(topology.tets, masses.size())) {
    const Eigen::Index share =
        std::max<Eigen::Index>(kRigid, count * static_cast<Eigen::Index>(piece.size()) / masses.size());
    const Eigen::VectorXd mass = masses(piece).transpose().replicate(3, 1).reshaped();
    modes.push_back(
        modesOfPiece(topology.rest_vertices(piece, Eigen::all), partOf(matrix.lower(), piece), mass, share));
  }
  return modes;
}

}  // namespace softbody
