#include "estimation/load_field.h"

#include <cmath>

#include "linear_solvers/positive_definite_solver.h"
#include "softbody_common/tet_geometry.h"
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

}  // namespace

Eigen::MatrixXd covarianceOfUnknownLoads(const TetTopology& topology, const TetMaterials& materials,
                                         const Eigen::VectorXd& masses, const DeformationModes& modes) {
  const Eigen::SparseMatrix<double> matrix = screenedPoisson(topology, masses).lower();
  PositiveDefiniteSolver smoother(matrix);
  smoother.factorize(matrix);
  // White noise w gives the forces M (M + l^2 L)^-1 M w; `along` holds sqrt(M)^-1 of that for each mode.
  Eigen::MatrixXd along(modes.shapes.rows(), modes.shapes.cols());
  Points shape(masses.size(), 3), smooth(masses.size(), 3);
  for (Eigen::Index i = 0; i < modes.shapes.cols(); ++i) {
    shape = masses.asDiagonal() * modes.shapes.col(i).reshaped<Eigen::RowMajor>(masses.size(), 3);
    smoother.solve(shape, &smooth);
    along.col(i) = (masses.cwiseSqrt().asDiagonal() * smooth).reshaped<Eigen::RowMajor>();
  }
  const Eigen::MatrixXd covariance = along.transpose() * along;
  // Twice the mean elastic energy, of a covariance of 1 and of the usual strain [J].
  const double energy = (covariance.diagonal().array() / modes.stiffness.array()).sum(),
               usual = materials.mean_youngs_modulus_pa * kUsualStrain * kUsualStrain *
                       tetVolumes(topology.rest_vertices, topology.tets).sum();
  return usual / energy * covariance;
}

}  // namespace softbody
