#include "estimation/load_field.h"

#include <algorithm>
#include <cmath>

#include "linear_solvers/positive_definite_solver.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "tets/tet_matrix.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

// Length over which unknown loads are alike, in edges of a cube with the body's volume: hands press on a part
// of a side.
constexpr double kSpread = 0.5;
// Strain under unknown loads, root mean square: soft bodies bend by that much, and seldom by more.
constexpr double kUsualStrain = 0.1;

/// M + l^2 L, with the Laplacian L weighted by density.
TetMatrix screenedPoisson(const TetTopology& topology, const Eigen::VectorXd& masses) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  const double length = kSpread * std::cbrt(volumes.sum()), density = masses.sum() / volumes.sum();
  TetMatrix matrix(topology.tets, topology.rest_vertices.rows());
  matrix.addToDiagonal(masses);
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    const Eigen::Matrix<double, 4, 3> gradients =
        shapeGradients(edgesOf(topology.rest_vertices, topology.tets.row(t)).inverse());
    matrix.addToTet(static_cast<int>(t),
                    length * length * density * volumes[t] * gradients * gradients.transpose());
  }
  return matrix;
}

/// sqrt(M)^-1 of the forces M (M + l^2 L)^-1 M w of white noise w, for each mode. Pieces do not act on each
/// other, so one mode of each is solved for at once.
std::vector<Eigen::MatrixXd> smoothed(const TetTopology& topology, const Eigen::VectorXd& masses,
                                      const std::vector<DeformationModes>& modes) {
  const Eigen::SparseMatrix<double> matrix = screenedPoisson(topology, masses).lower();
  PositiveDefiniteSolver smoother(matrix);
  smoother.factorize(matrix);
  const std::vector<std::vector<int>> pieces = verticesOfPieces(topology.tets, masses.size());
  std::vector<Eigen::MatrixXd> result;
  Eigen::Index most = 0;
  for (const DeformationModes& piece : modes) {
    result.emplace_back(piece.shapes.rows(), piece.shapes.cols());
    most = std::max(most, piece.shapes.cols());
  }
  Points shape(masses.size(), 3), smooth(masses.size(), 3);
  for (Eigen::Index i = 0; i < most; ++i) {
    shape.setZero();
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (i < modes[p].shapes.cols())
        shape(pieces[p], Eigen::all) = modes[p].shapes.col(i).reshaped<Eigen::RowMajor>(pieces[p].size(), 3);
    }
    shape = masses.asDiagonal() * shape;
    smoother.solve(shape, &smooth);
    smooth = masses.cwiseSqrt().asDiagonal() * smooth;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (i < modes[p].shapes.cols())
        result[p].col(i) = smooth(pieces[p], Eigen::all).reshaped<Eigen::RowMajor>();
    }
  }
  return result;
}

}  // namespace

std::vector<Eigen::MatrixXd> covariancesOfUnknownLoads(const TetTopology& topology,
                                                       const TetMaterials& materials,
                                                       const Eigen::VectorXd& masses,
                                                       const std::vector<DeformationModes>& modes) {
  std::vector<Eigen::MatrixXd> covariances;
  double energy = 0.0;  // twice the mean elastic energy of these covariances [J]
  for (const Eigen::MatrixXd& along : smoothed(topology, masses, modes)) {
    const DeformationModes& piece = modes[covariances.size()];
    covariances.emplace_back(along.transpose() * along);
    energy += (covariances.back().diagonal().array() / piece.stiffness.array()).sum();
  }
  // The same of the usual strain [J].
  const double usual = materials.mean_youngs_modulus_pa * kUsualStrain * kUsualStrain *
                       tetVolumes(topology.rest_vertices, topology.tets).sum();
  for (Eigen::MatrixXd& covariance : covariances) covariance *= usual / energy;
  return covariances;
}

}  // namespace softbody
