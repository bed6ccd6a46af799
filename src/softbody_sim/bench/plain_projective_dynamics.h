#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <vector>

#include "elasticity/corotated_elasticity.h"
#include "softbody_common/types.h"
#include "time_step/incremental_potential.h"

namespace softbody::bench {

/// Projective dynamics as Bouaziz et al. 2014 write it down, without acceleration: each deformation gradient,
/// of a tet or smoothed around a vertex, is projected by a singular value decomposition, then one sparse
/// system that was factored once is solved. The energy is the product's, in double. The yardstick of
/// bench_projective_dynamics.
class PlainProjectiveDynamics {
 public:
  /// Factors the system for the potential's inertia and targets. @param smoothing as in CorotatedElasticity.
  PlainProjectiveDynamics(const TetTopology& topology, const Lame& lame,
                          const IncrementalPotential& potential, double smoothing = 0.0);

  /// One local and one global step, from x to x. Targets without normals only.
  void iterate(const IncrementalPotential& potential, Points* x);

  void localStep(const Points& x);
  void globalStep(const IncrementalPotential& potential, Points* x);

 private:
  /// A deformation gradient smoothed around a vertex.
  struct Patch {
    std::vector<int> vertices;
    Eigen::Matrix3Xd gradients;  ///< #vertices [1/m]
    double volume;               ///< the smoothed share of it [m^3]
    Eigen::Matrix3d projection;
  };
  void addTets(const Points& rest_vertices);
  void addPatches(const Points& rest_vertices, double smoothing);
  /// Adds a strain's part of the matrix.
  template <typename Vertices, typename Gradients>
  void addToMatrix(const Vertices& vertices, double volume, const Gradients& gradients);

  Tets tets_;
  std::vector<Eigen::Matrix<double, 3, 4>> shape_gradients_;
  Eigen::VectorXd volumes_;
  std::vector<Patch> patches_;
  Lame lame_;
  std::vector<Eigen::Matrix3d> projections_;  ///< weighted sum over a tet's constraints
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::MatrixX3d right_side_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace softbody::bench
