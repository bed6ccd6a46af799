#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "softbody_common/geometry/types.h"
#include "time_step/incremental_potential.h"

namespace softbody::bench {

/// Reference for bench_projective_dynamics: projective dynamics as in Bouaziz et al. 2014, without
/// acceleration. A singular value decomposition projects each deformation gradient of a tet or a smoothed
/// patch; then one prefactored sparse system is solved. The energy is that of ProjectiveDynamics, in double.
class PlainProjectiveDynamics {
 public:
  /// Factors the system of the potential's inertia and targets. @param smoothing as in CorotatedElasticity.
  PlainProjectiveDynamics(const TetTopology& topology, const Lame& lame,
                          const IncrementalPotential& potential, double smoothing = 0.0);

  /// One local and one global step. Supports only targets without normals. @param x start, then result [m].
  void iterate(const IncrementalPotential& potential, Points* x);

  void localStep(const Points& x);
  void globalStep(const IncrementalPotential& potential, Points* x);

 private:
  /// A deformation gradient smoothed around a vertex.
  struct Patch {
    std::vector<int> vertices;
    Eigen::Matrix3Xd gradients;  ///< #vertices [1/m]
    double volume;               ///< part with smoothed strains [m^3]
    Eigen::Matrix3d projection;
  };
  void addTets(const Points& rest_vertices);
  void addPatches(const Points& rest_vertices, double smoothing);
  /// Adds the matrix of one deformation gradient.
  template <typename Vertices, typename Gradients>
  void addToMatrix(const Vertices& vertices, double volume, const Gradients& gradients);

  Tets tets_;
  std::vector<Eigen::Matrix<double, 3, 4>> shape_gradients_;
  Eigen::VectorXd volumes_;
  std::vector<Patch> patches_;
  Lame lame_;
  std::vector<Eigen::Matrix3d> projections_;  ///< per tet: weighted sum over its constraints
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::MatrixX3d right_side_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace softbody::bench
